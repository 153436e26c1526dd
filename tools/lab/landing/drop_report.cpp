#include "tools/lab/landing/drop_report.h"

#include <cmath>
#include <string>

namespace sprung {
namespace {

constexpr double kPlotted_m = 0.3;
constexpr double kPlotted_s = 0.7;

struct DropSeries {
  std::vector<double> time_s, length_m, motor_Nm, output_Nm;
};

/// Of the joint that carries most at each moment.
double worst(double hip, double knee) { return std::max(std::abs(hip), std::abs(knee)); }

DropSeries watch(const RobotConfig& robot, const DropRequest& request, JumpMode mode,
                 const ScriptRunner& run) {
  DropSeries out;
  const std::int64_t release = release_cycle(robot, request.preset);
  run_drop(drop_script(robot, request.preset, request.sim, {mode, kPlotted_m, 0.0}), run,
           [&](const CycleRecord& cycle) {
             const double time_s = static_cast<double>(cycle.truth.stamp.seq - release) * robot.cycle_s;
             if (time_s < 0.0 || time_s > kPlotted_s) return;
             const auto& joints = cycle.joint_state.joints;
             const auto& truth = cycle.truth.joints;
             out.time_s.push_back(time_s);
             out.length_m.push_back(cycle.truth.base_in_world_m[2] -
                                    cycle.truth.legs.front().true_foot_in_world_m[2]);
             out.motor_Nm.push_back(worst(joints[0].motor_side_torque_Nm, joints[1].motor_side_torque_Nm));
             out.output_Nm.push_back(
                 worst(truth[0].true_gear_output_torque_Nm, truth[1].true_gear_output_torque_Nm));
           });
  return out;
}

report::Section landings(const DropExperiment& experiment) {
  report::Section out{"Landings"};
  report::Table table{"Worst of hip and knee, from touchdown until the leg stands up again",
                      {"mode", "height (m)", "motor side (Nm)", "true gear output (Nm)",
                       "foot's speed at touchdown (m/s)", "leg folded"}};
  for (const DropRow& row : experiment.landings) {
    const DropResult& r = row.result;
    table.rows.push_back({name(row.mode), row.height_m, r.peak_motor_torque_Nm, r.peak_output_torque_Nm,
                          r.touchdown_speed_m_s, r.folded ? "yes" : "no"});
  }
  out.tables = {table};
  return out;
}

report::Section comparison(const DropExperiment& experiment) {
  report::Section out{"Adaptive landing and the papers' hybrid law, floor not where it is expected"};
  report::Plot plot{"Each seed", {"touchdown later than expected", "ms"}, {"true gear output peak", "Nm"}};
  std::vector<double> x, adaptive, paper;
  for (const DropPair& pair : experiment.pairs) {
    x.push_back(1e3 * pair.surprise_s);
    adaptive.push_back(pair.adaptive.peak_output_torque_Nm);
    paper.push_back(pair.paper.peak_output_torque_Nm);
  }
  plot.series = {{"adaptive", x, adaptive, report::Style::kPoints, 0},
                 {"papers' hybrid law", x, paper, report::Style::kPoints, 1}};
  out.plots = {plot};
  return out;
}

}  // namespace

std::vector<report::Section> drop_sections(const RobotConfig& robot, const DropRequest& request,
                                           const DropExperiment& experiment, const ScriptRunner& run) {
  report::Section one{"One drop from 0.3 m in each mode"};
  report::Plot length{"Leg's length", {"time since release", "s"}, {"hip to foot", "m"}};
  report::Plot output{"True gear output, worse joint", {"time since release", "s"}, {"torque", "Nm"}};
  report::Plot motor{"Motor side, worse joint", {"time since release", "s"}, {"torque", "Nm"}};
  int colour = 0;
  for (const JumpMode mode :
       {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kAdaptive}) {
    const DropSeries s = watch(robot, request, mode, run);
    length.series.push_back({name(mode), s.time_s, s.length_m, report::Style::kLine, colour});
    output.series.push_back({name(mode), s.time_s, s.output_Nm, report::Style::kLine, colour});
    motor.series.push_back({name(mode), s.time_s, s.motor_Nm, report::Style::kLine, colour++});
  }
  one.plots = {length, output, motor};
  return {landings(experiment), comparison(experiment), one};
}

}  // namespace sprung
