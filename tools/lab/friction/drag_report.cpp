#include "tools/lab/friction/drag_report.h"

#include <cmath>
#include <cstdio>

namespace sprung {
namespace {

using report::Plot;
using report::Style;

std::string reference_name(const DragResult& result) {
  return result.sensed ? "torque sensor, 300 Hz" : "simulation's truth";
}

/// One column of all phases, with a gap between them.
template <typename Value>
std::vector<double> column(const DragResult& result, Value value) {
  std::vector<double> out;
  for (const DragPhaseResult& phase : result.phases) {
    for (const DragSample& sample : phase.samples) out.push_back(value(sample));
    out.push_back(kNaN);
  }
  return out;
}

/// A gap's time, so that x stays ascending.
std::vector<double> times(const DragResult& result) {
  std::vector<double> out;
  for (const DragPhaseResult& phase : result.phases) {
    for (const DragSample& sample : phase.samples) out.push_back(sample.time_s);
    out.push_back(phase.to_s);
  }
  return out;
}

std::vector<report::Shade> shades(const DragResult& result) {
  std::vector<report::Shade> out;
  for (const DragPhaseResult& phase : result.phases) out.push_back({phase.from_s, phase.to_s, phase.name});
  return out;
}

Plot torque_plot(const DragResult& result) {
  Plot out{"Gear output torque", {"time", "s"}, {"torque on the link", "Nm"}};
  const std::vector<double> t = times(result);
  out.series = {
      {"estimate", t, column(result, [](const DragSample& s) { return s.estimate_Nm; }), Style::kLine, 0},
      {reference_name(result), t, column(result, [](const DragSample& s) { return s.reference_Nm; }),
       Style::kLine, 1},
      {"papers' equation (6)", t, column(result, [](const DragSample& s) { return s.paper_Nm; }),
       Style::kLine, 2}};
  out.bands = {{"stated bound, 95 %", t,
                column(result, [](const DragSample& s) { return s.estimate_Nm - s.bound_Nm; }),
                column(result, [](const DragSample& s) { return s.estimate_Nm + s.bound_Nm; }), 0}};
  out.shades = shades(result);
  return out;
}

Plot error_plot(const DragResult& result) {
  Plot out{"Errors", {"time", "s"}, {"estimate minus reference", "Nm"}};
  const std::vector<double> t = times(result);
  out.series = {
      {"estimate", t, column(result, [](const DragSample& s) { return s.estimate_Nm - s.reference_Nm; }),
       Style::kLine, 0},
      {"papers' equation (6)", t,
       column(result, [](const DragSample& s) { return s.paper_Nm - s.reference_Nm; }), Style::kLine, 2}};
  out.bands = {{"stated bound, 95 %", t, column(result, [](const DragSample& s) { return -s.bound_Nm; }),
                column(result, [](const DragSample& s) { return s.bound_Nm; }), 0}};
  out.shades = shades(result);
  return out;
}

Plot motion_plot(const DragResult& result) {
  Plot out{"Where hand and link are", {"time", "s"}, {"joint angle", "rad"}};
  out.series = {{"link, estimated", result.trace.time_s, result.trace.angle_rad, Style::kLine, 0},
                {"hand", result.trace.time_s, result.trace.hand_angle_rad, Style::kDashedLine, 3}};
  out.shades = shades(result);
  return out;
}

Plot hand_plot(const DragResult& result) {
  Plot out{"What the hand does", {"time", "s"}, {"torque of the hand about the joint", "Nm"}};
  out.series = {{"hand", result.trace.time_s, result.trace.hand_torque_Nm, Style::kLine, 3}};
  out.shades = shades(result);
  return out;
}

void add_row(const std::string& name, const DragScore& s, report::Table& table) {
  char coverage[32];
  std::snprintf(coverage, sizeof coverage, "%.1f %%", 100.0 * s.coverage);
  table.rows.push_back({name, s.samples, s.reference_rms_Nm, s.rms_Nm, s.mean_Nm, s.max_Nm, coverage,
                        s.half_width_Nm, s.paper_rms_Nm});
}

}  // namespace

report::Section drag_section(const DragResult& result) {
  report::Section out{"Friction: " + result.friction};
  out.text = {"A hand (a spring and damper about the joint of " + result.joint +
                  ", 320 Nm/rad and 20 Nm s/rad, when it gives way 24 and 5) goes its own way; the drive is "
                  "off (off_*), holds its position "
                  "(held_*) or moves by itself at 0.8 rad/s (moved_*).",
              result.sensed ? "Reference: the bench's torque sensor between gear and arm, 300 Hz, 0.1 Nm of "
                              "noise, which is part of every error; "
                              "the estimate is read off at each reading's own time."
                            : "Reference: SIM_TRUTH, since this robot has no torque sensor. Its drives are "
                              "on throughout: without power the other "
                              "joints would give way too."};
  report::Table table{"Scores",
                      {"phase", "samples", "reference RMS (Nm)", "error RMS (Nm)", "mean error (Nm)",
                       "largest (Nm)", "within the bound", "mean bound (Nm)", "papers' equation RMS (Nm)"}};
  for (const DragPhaseResult& phase : result.phases) add_row(phase.name, phase.score, table);
  add_row("all", result.all, table);
  out.tables = {table};
  out.plots = {torque_plot(result), error_plot(result), motion_plot(result), hand_plot(result)};
  return out;
}

std::string drag_table(const DragResult& result) {
  char line[200];
  std::snprintf(line, sizeof line, "%s against %s; friction: %s\n%-20s %9s %9s %9s %9s %10s\n",
                result.joint.c_str(), reference_name(result).c_str(), result.friction.c_str(), "phase",
                "RMS, Nm", "max, Nm", "bound, Nm", "within", "papers, Nm");
  std::string out = line;
  const auto add = [&](const std::string& name, const DragScore& s) {
    std::snprintf(line, sizeof line, "%-20s %9.2f %9.2f %9.2f %8.1f%% %10.2f\n", name.c_str(), s.rms_Nm,
                  s.max_Nm, s.half_width_Nm, 100.0 * s.coverage, s.paper_rms_Nm);
    out += line;
  };
  for (const DragPhaseResult& phase : result.phases) add(phase.name, phase.score);
  add("all", result.all);
  return out;
}

}  // namespace sprung
