#include "tools/lab/leg/step_response_report.h"

namespace sprung {
namespace {

using report::Plot;
using report::Style;

constexpr double kShown_s = 0.12;

report::Table times_table(const StepResponseResult& result) {
  report::Table out{"The knee's torque after a step",
                    {"case", "floor (N/m)", "signal", "from (Nm)", "to (Nm)", "peak (Nm)",
                     "time to peak (ms)", "time to 90 % (ms)"}};
  for (const StepResult& done : result.cases) {
    const auto add = [&](const char* signal, const StepFigures& s) {
      out.rows.push_back({done.config.name, done.config.floor_N_m, signal, s.start_Nm, s.end_Nm, s.peak_Nm,
                          s.peak_ms, s.t90_ms});
    };
    add("motor side, estimated", done.estimated_motor_side);
    add("motor, true", done.motor);
    add("gear output, true", done.output);
  }
  out.note =
      "S0: peak at 4.75 ms, motor side, position control. No time to peak: the torque does not exceed its "
      "final value by 10 % of the step.";
  return out;
}

Plot torque_plot(const StepResult& done) {
  Plot out{
      "Knee, " + done.config.name, {"time from the first DRIVE_COMMAND of the step", "ms"}, {"torque", "Nm"}};
  std::vector<double> time_ms;
  for (const double time_s : done.knee.time_s) {
    if (time_s <= kShown_s) time_ms.push_back(1e3 * time_s);
  }
  const auto add = [&](const char* name, const std::vector<double>& all_Nm, Style style) {
    const auto end = all_Nm.begin() + static_cast<std::ptrdiff_t>(time_ms.size());
    out.series.push_back({name, time_ms, {all_Nm.begin(), end}, style});
  };
  add("gear output, true", done.knee.output_Nm, Style::kLine);
  add("motor, true", done.knee.motor_Nm, Style::kLine);
  add("motor side, estimated", done.knee.estimated_motor_side_Nm, Style::kDashedLine);
  out.markers = {{0.0, "step"}};
  return out;
}

}  // namespace

report::Section step_response_section(const StepResponseResult& result) {
  report::Section out{"Step response"};
  out.text = {
      "thrust: the jump in position control, from the first set-point of its thrust; 90 % of the highest "
      "torque of the push-off, "
      "since the motion goes on.",
      "rigid_floor, floor_like_gear: the hip is held, the foot presses on a floor without friction, 20 mm "
      "short of where the spring of its compliance wants it, and a stiffer spring (a second comply) makes "
      "the "
      "force step from 100 to 300 N; 90 % of the step. The gears are "
      "rigid: the softer floor "
      "gives as much as a gear of 41000 Nm/rad would, so that rotor and spring have the 36 Hz of errata E10.",
      "Samples are 1 ms apart. Zero is the first DRIVE_COMMAND of the step; its LEG_COMMAND is 1 ms older."};
  out.tables = {times_table(result)};
  for (const StepResult& done : result.cases) out.plots.push_back(torque_plot(done));
  return out;
}

}  // namespace sprung
