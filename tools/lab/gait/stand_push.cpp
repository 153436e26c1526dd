#include "tools/lab/gait/stand_push.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "tools/lab/gait/legged_trial.h"

namespace sprung {

namespace {

using report::hundredths;
using report::Plot;
using report::Series;
using report::Style;

report::Table summary_table(const StandPushResult& result) {
  report::Table out{"Peak torque of hip and knee above the static torque",
                    {"push", "signal", "position (Nm)", "compliance (Nm)", "ratio", "foot off, position (mm)",
                     "foot off, compliance (mm)"}};
  for (const PushPair& pair : result.pushes) {
    const PushScore& p = pair.position.score;
    const PushScore& c = pair.compliance.score;
    out.rows.push_back({pair.push.name, "motor side, papers' equation", hundredths(p.excess_motor_Nm),
                        hundredths(c.excess_motor_Nm),
                        hundredths(push_ratio(c.excess_motor_Nm, p.excess_motor_Nm)),
                        hundredths(p.foot_off_mm), hundredths(c.foot_off_mm)});
    out.rows.push_back({pair.push.name, "gear output, true", hundredths(p.excess_output_Nm),
                        hundredths(c.excess_output_Nm),
                        hundredths(push_ratio(c.excess_output_Nm, p.excess_output_Nm)), "", ""});
  }
  const auto pair = [](const Vec3& v) {
    return report::number_text(v[0]) + ", " + report::number_text(v[2]);
  };
  out.note = "Compliance: K " + pair(result.gains.stiffness_N_m) + " N/m, D " +
             pair(result.gains.damping_N_s_m) + " N s/m forward and up at each foot, " +
             report::number_text(result.friction_compensation) +
             " of friction compensated. Position: loops of " +
             report::number_text(result.position_stiffness_Nm_rad) + " Nm/rad, " +
             report::number_text(result.position_damping_Nm_s_rad) + " Nm s/rad at each joint.";
  return out;
}

/// The largest |torque| of all hips and knees.
Series load(const PushRun& run, std::vector<double> PushSample::*torques, const std::string& name, int colour,
            Style style) {
  Series out{name, {}, {}, style, colour};
  for (const PushSample& sample : run.samples) {
    double most = 0.0;
    for (const double torque : sample.*torques) most = std::max(most, std::abs(torque));
    out.x.push_back(sample.time_s);
    out.y.push_back(most);
  }
  return out;
}

Plot load_plot(const PushPair& pair) {
  Plot out{std::string("Torque of the joint that carries most, ") + pair.push.name,
           {"time since the push began", "s"},
           {"torque", "Nm"}};
  out.series = {
      load(pair.position, &PushSample::gear_output_Nm, "position, gear output", 0, Style::kLine),
      load(pair.position, &PushSample::motor_side_Nm, "position, motor side", 0, Style::kDashedLine),
      load(pair.compliance, &PushSample::gear_output_Nm, "compliance, gear output", 1, Style::kLine),
      load(pair.compliance, &PushSample::motor_side_Nm, "compliance, motor side", 1, Style::kDashedLine)};
  out.shades = {{0.0, pair.push.length_s(), "push"}};
  return out;
}

report::Section stand_push_section(const StandPushResult& result) {
  report::Section out{"Standing, pushed"};
  out.text = {
      "The robot stands free on its feet and is pounded (15 N s within 0.1 s), led down by 10 mm and up by "
      "30 mm (1 s there, 1 s held, 1 s "
      "back), and pressed down with 150 N as slowly, once in position control and once on its virtual "
      "springs (gait stand); and more of the first two. Static "
      "torque: the mean before the push. The papers' joint torque is the motor's; what a pound puts through "
      "the "
      "legs to the floor passes every gear, whatever the control, since rotors and friction hold the "
      "joints. Under the same slow force (pushforce) the gears' outputs carry the same load, by "
      "statics: the slow push that tells one from the other is the one of the same way."};
  out.tables = {summary_table(result)};
  for (const PushPair& pair : result.pushes) out.plots.push_back(load_plot(pair));
  return out;
}

constexpr double kSettleStanding_s = 2.0;  // on the springs, or as long in position control
constexpr double kBefore_s = 1.0;
constexpr double kWatch_s = 3.0;

Vec3 foot_in_trunk_m(const SimTruth& truth, std::size_t leg) {
  const auto& q = truth.base_quaternion_wxyz;
  const Eigen::Quaterniond world_from_trunk(q[0], q[1], q[2], q[3]);
  const Vec3& foot = truth.legs[leg].true_foot_in_world_m;
  const Vec3& base = truth.base_in_world_m;
  const Eigen::Vector3d away(foot[0] - base[0], foot[1] - base[1], foot[2] - base[2]);
  const Eigen::Vector3d out = world_from_trunk.conjugate() * away;
  return {out.x(), out.y(), out.z()};
}

PushSample sample_of(const RobotConfig& config, const InProcessRobot& robot, double time_s) {
  PushSample out;
  out.time_s = time_s;
  for (std::size_t leg = 0; leg < config.legs.size(); ++leg) {
    for (std::size_t j = 1; j < config.legs[leg].joints.size(); ++j) {  // hip and knee
      const auto joint = static_cast<std::size_t>(config.legs[leg].joints[j]);
      out.gear_output_Nm.push_back(robot.truth().joints[joint].true_gear_output_torque_Nm);
      out.motor_side_Nm.push_back(robot.joint_state().joints[joint].motor_side_torque_Nm);
    }
    out.foot_in_trunk_m.push_back(foot_in_trunk_m(robot.truth(), leg));
  }
  return out;
}

void push_trunk(InProcessRobot& robot, double force_N, double cycle_s) {
  SimControl control;
  control.kind = SimControlKind::kWrench;
  control.wrench = {0.0, 0.0, force_N, 0.0, 0.0, 0.0};
  control.value = cycle_s;  // a straight line to the next cycle's
  control.duration_s = 2.0 * cycle_s;
  robot.sim().control(control);
}

void stand_on_springs(LeggedTrial& trial, const RobotConfig& robot) {
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = gait_index(robot, "stand");
  trial.say(walk);
}

struct Timed {
  PushRun run;
  DesiredLeg standing;  ///< as the legs were commanded before the push
  double simulated_s = 0.0;
};

Timed run_push(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
               const TrunkPush& push, bool compliant) {
  LeggedTrial trial(robot, preset, lying(sim));
  trial.stand_up();
  if (compliant) stand_on_springs(trial, robot);
  trial.run(kSettleStanding_s);
  Timed out;
  out.standing = trial.robot().leg_command().legs.front();
  TrunkHand hand(push, robot.cycle_s);
  double time_s = -kBefore_s, start_m = 0.0;
  trial.run(kBefore_s + push.length_s() + kWatch_s, [&](InProcessRobot& in) {
    const double height_m = in.truth().base_in_world_m[2];
    if (time_s < 0.0) start_m = height_m;
    if (time_s >= 0.0 && time_s < push.length_s())
      push_trunk(in, hand.step_N(time_s, height_m - start_m), robot.cycle_s);
    out.run.samples.push_back(sample_of(robot, in, time_s));
    time_s += robot.cycle_s;
  });
  out.run.score = score_push(out.run.samples);
  out.simulated_s = trial.simulated_s();
  return out;
}

/// [design choice] What breaks a gear is its output: springs are no harder on it than position control, but
/// for what the noise does.
constexpr double kMostPushOutput = 1.05;

std::optional<double> highest_ratio(const std::string& push) {
  if (push == "impulse") return 0.4;
  if (push == "pushdown") return 0.6;
  return std::nullopt;
}

}  // namespace

StandPushResult run_stand_push(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                               const std::vector<TrunkPush>& pushes, const ParallelOptions& parallel) {
  StandPushResult out;
  const ActuatorConfig& knee = robot.actuators.at(
      static_cast<std::size_t>(robot.legs.at(0).actuators.back()));
  out.position_stiffness_Nm_rad = knee.position_stiffness_Nm_rad;
  out.position_damping_Nm_s_rad = knee.position_damping_Nm_s_rad;
  std::vector<Timed> runs = parallel_map(
      2 * pushes.size(),
      [&](std::size_t i) { return run_push(robot, preset, sim, pushes[i / 2], i % 2 == 1); }, parallel);
  if (!runs.empty()) {  // what acted, whatever the preset and the gait made of it
    const DesiredLeg& standing = runs[1].standing;
    out.gains = {standing.stiffness_N_m, standing.damping_N_s_m, standing.velocity_feedforward};
    out.friction_compensation = standing.friction_compensation;
  }
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    out.pushes.push_back({pushes[i], std::move(runs[2 * i].run), std::move(runs[2 * i + 1].run)});
    out.simulated_s += runs[2 * i].simulated_s + runs[2 * i + 1].simulated_s;
  }
  return out;
}

std::vector<ReportRow> stand_push_rows(const StandPushResult& result) {
  std::vector<ReportRow> out;
  const auto add = [&](const std::string& name, const char* unit, double value, const Bounds& bounds = {}) {
    out.push_back(row("stand_push." + name, unit, value, bounds));
  };
  for (const PushPair& pair : result.pushes) {
    const std::string name = pair.push.name;
    const PushScore& position = pair.position.score;
    const PushScore& compliance = pair.compliance.score;
    add(name + ".ratio", "", push_ratio(compliance.excess_motor_Nm, position.excess_motor_Nm),
        {{}, highest_ratio(name)});
    add(name + ".position", "Nm", position.excess_motor_Nm);
    add(name + ".compliance", "Nm", compliance.excess_motor_Nm);
    add(name + ".output_ratio", "", push_ratio(compliance.excess_output_Nm, position.excess_output_Nm),
        at_most(kMostPushOutput));
    add(name + ".output_position", "Nm", position.excess_output_Nm);
    add(name + ".output_compliance", "Nm", compliance.excess_output_Nm);
    add(name + ".foot_off", "mm", compliance.foot_off_mm, at_most(5.0));
  }
  add("gains.stiffness_forward", "N/m", result.gains.stiffness_N_m[0]);
  add("gains.stiffness_up", "N/m", result.gains.stiffness_N_m[2]);
  add("gains.damping_forward", "Ns/m", result.gains.damping_N_s_m[0]);
  add("gains.damping_up", "Ns/m", result.gains.damping_N_s_m[2]);
  add("gains.friction_compensation", "", result.friction_compensation);
  add("gains.position_stiffness", "Nm/rad", result.position_stiffness_Nm_rad);
  add("gains.position_damping", "Nms/rad", result.position_damping_Nm_s_rad);
  return out;
}

Experiment stand_push_experiment() {
  Experiment out;
  out.name = "stand_push";
  out.what =
      "A walking robot stands and is pounded, pushed down and lifted, in position control and on its virtual "
      "springs: peak torques of hip and knee above the static ones.";
  out.question =
      "How much less do hip and knee carry on virtual springs than in position control when the standing "
      "robot "
      "is pounded, pushed down or lifted?";
  out.robot = "pegasus";
  out.takes = {Common::kPreset, Common::kPlant, Common::kSeparate, Common::kOut};
  out.example = "--seed 1 --out report";
  out.in_all = {RobotKind::kWalker};
  out.many_cases = true;
  out.run = [](const ExperimentInput& in) {
    refuse_separate(in);
    const StandPushResult result = run_stand_push(in.robot, in.preset, in.sim, trunk_pushes(), in.parallel);
    return ExperimentOutput{stand_push_rows(result), result.simulated_s, {stand_push_section(result)}};
  };
  return out;
}

}  // namespace sprung
