#include "tools/lab/leg/step_response.h"

#include <cmath>
#include <stdexcept>

#include "tools/lab/jump/jump_experiment.h"

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

namespace {

using namespace step_response;

constexpr std::size_t kKnee = 1;
constexpr const char* kLikeGear = "floor_like_gear";
constexpr double kPaperPeak_ms = 4.75;  // S0, motor side; 90 % of it were there before
constexpr double kAnymal90_ms = 13.0;   // what S0 compares itself with
/// Errata E10: the output's peak.
constexpr double kHalfPeriodLeast_ms = 11.0, kHalfPeriodMost_ms = 19.0;

constexpr double kSettleEstimator_s = 0.1;  // the estimator has settled
constexpr double kCentre_s = 2.0;           // compliance; the foot slides under the hip
constexpr double kPress_s = 2.8;            // kBefore_N alone
constexpr double kStep_s = 3.5;
constexpr double kEnd_s = 4.0;
constexpr double kCentring_N_m = 20000.0, kCentring_N_s_m = 300.0;
constexpr double kShownBefore_s = 0.02;
constexpr double kThrustWatch_s = 0.12;  // by then the knee pushes no more

std::int64_t cycle_at(const RobotConfig& robot, double time_s) {
  return std::llround(time_s / robot.cycle_s);
}

/// A spring that presses with `force_N`; sideways none: what friction leaves of it would be torque of the
/// knee.
OperatorCommand press(const RobotConfig& robot, double time_s, double force_N) {
  OperatorCommand out = scripted(OperatorKind::kComply, cycle_at(robot, time_s));
  out.stiffness_N_m = {0.0, 0.0, force_N / kPressed_m};
  out.damping_N_s_m = {0.0, 0.0, 0.0};
  out.friction_compensation = 0.0;
  return out;
}

RunScript locked_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                        const StepCase& config) {
  RunScript out{robot, preset, sim, {}, cycle_at(robot, kEnd_s)};
  out.sim.plant["suspended"] = robot.preset(preset).stand_length_m - kPressed_m +
                               robot.legs.front().foot_radius_m;
  out.sim.plant["floor_height"] = 0.0;
  out.sim.plant["ground_stiffness"] = config.floor_N_m;
  out.sim.plant["ground_friction"] = 0.0;
  out.commands = {scripted(OperatorKind::kStand, cycle_at(robot, kSettleEstimator_s)),
                  press(robot, kCentre_s, kBefore_N), press(robot, kPress_s, kBefore_N),
                  press(robot, kStep_s, kAfter_N)};
  out.commands[1].stiffness_N_m[0] = kCentring_N_m;
  out.commands[1].damping_N_s_m[0] = kCentring_N_s_m;
  return out;
}

void add_sample(const CycleRecord& cycle, double time_s, StepTrace& out) {
  out.time_s.push_back(time_s);
  out.estimated_motor_side_Nm.push_back(cycle.joint_state.joints[kKnee].motor_side_torque_Nm);
  out.motor_Nm.push_back(cycle.truth.joints[kKnee].true_motor_torque_Nm);
  out.output_Nm.push_back(cycle.truth.joints[kKnee].true_gear_output_torque_Nm);
}

/// From kShownBefore_s before `zero_s` to `watch_s` after it; times from `zero_s` on.
StepTrace around(const StepTrace& all, double zero_s, double watch_s) {
  StepTrace out;
  for (std::size_t i = 0; i < all.time_s.size(); ++i) {
    const double time_s = all.time_s[i] - zero_s;
    if (time_s < -kShownBefore_s - 1e-9 || time_s > watch_s + 1e-9) continue;
    out.time_s.push_back(time_s);
    out.estimated_motor_side_Nm.push_back(all.estimated_motor_side_Nm[i]);
    out.motor_Nm.push_back(all.motor_Nm[i]);
    out.output_Nm.push_back(all.output_Nm[i]);
  }
  return out;
}

/// LEG_COMMAND(k) is in DRIVE_COMMAND(k + 1): docs/architecture.md.
StepTrace record(const RunScript& script, const StepCase& config, const ScriptRunner& run) {
  StepTrace all;
  const double cycle_s = script.robot.cycle_s;
  double zero_s = config.locked ? kStep_s + cycle_s : kNaN;
  run(
      script,
      [&](const CycleRecord& cycle) {
        const double time_s = static_cast<double>(cycle.drive_state.stamp.seq) * cycle_s;
        add_sample(cycle, time_s, all);
        const bool thrust = !config.locked && cycle.motion_state.state == MotionPhase::kThrust;
        if (thrust && std::isnan(zero_s)) zero_s = time_s + cycle_s;
      },
      throw_unless_obeyed);
  if (std::isnan(zero_s)) throw std::runtime_error("the robot never began to jump");
  return around(all, zero_s, config.locked ? kEnd_s - kStep_s : kThrustWatch_s);
}

StepResult result_of(const StepCase& config, StepTrace trace) {
  const StepEnd end = config.locked ? StepEnd::kFinal : StepEnd::kHighest;
  StepResult out{config, std::move(trace), {}, {}, {}};
  out.estimated_motor_side = step_figures(out.knee.time_s, out.knee.estimated_motor_side_Nm, end);
  out.motor = step_figures(out.knee.time_s, out.knee.motor_Nm, end);
  out.output = step_figures(out.knee.time_s, out.knee.output_Nm, end);
  return out;
}

}  // namespace

std::vector<StepCase> step_cases(const RobotConfig& robot, double stand_length_m) {
  if (robot.legs.size() != 1 || robot.legs.front().kinematics != "two_link")
    throw std::invalid_argument("step_response needs a planar leg, as single_leg is; " + robot.name +
                                " is none");
  const double thigh_m = robot.legs.front().links[0].length_m;
  const double shank_m = robot.legs.front().links[1].length_m;
  const double length_m = stand_length_m - kPressed_m;
  const double cosine = (thigh_m * thigh_m + length_m * length_m - shank_m * shank_m) /
                        (2.0 * thigh_m * length_m);
  const double lever_m = thigh_m * std::sqrt(1.0 - cosine * cosine);  // of a vertical force about the knee
  return {{"thrust", false, kNaN},
          {"rigid_floor", true, kRigidFloor_N_m},
          {kLikeGear, true, kGear_Nm_rad / (lever_m * lever_m)}};
}

StepResponseResult run_step_response(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run,
                                     const ParallelOptions& parallel) {
  const std::vector<StepCase> cases = step_cases(robot, robot.preset(preset).stand_length_m);
  if (robot.preset(preset).stiffness_ramp_s > 0.0)
    throw std::invalid_argument(
        "preset " + preset +
        " has a stiffness_ramp, so that no force of a spring can step: use another, as paper");
  std::vector<RunScript> scripts;
  StepResponseResult out;
  for (const StepCase& config : cases) {
    scripts.push_back(config.locked ? locked_script(robot, preset, sim, config)
                                    : jump_script(robot, preset, sim, JumpMode::kPosition, 1));
    out.simulated_s += static_cast<double>(scripts.back().cycles) * robot.cycle_s;
  }
  out.cases = parallel_map(
      cases.size(), [&](std::size_t i) { return result_of(cases[i], record(scripts[i], cases[i], run)); },
      parallel);
  return out;
}

std::vector<ReportRow> step_response_rows(const StepResponseResult& result) {
  std::vector<ReportRow> out;
  for (const StepResult& done : result.cases) {
    const bool thrust = !done.config.locked;
    const std::string prefix = thrust ? "step_response." : "step_response." + done.config.name + ".";
    const auto add = [&](const char* quantity, double value_ms, const Bounds& bounds) {
      out.push_back(row(prefix + quantity, "ms", value_ms, bounds));
    };
    add("motor.peak", done.estimated_motor_side.peak_ms, demanded(thrust, {{}, {}, kPaperPeak_ms}));
    add("motor.t90", done.estimated_motor_side.t90_ms, at_most(thrust ? kPaperPeak_ms : kAnymal90_ms));
    add("output.peak", done.output.peak_ms,
        demanded(done.config.name == kLikeGear, between(kHalfPeriodLeast_ms, kHalfPeriodMost_ms)));
    add("output.t90", done.output.t90_ms, demanded(!thrust, at_most(kAnymal90_ms)));
  }
  return out;
}

Experiment step_response_experiment() {
  Experiment out;
  out.name = "step_response";
  out.what =
      "How fast the knee's torque follows: at the start of a jump in position control, and as a torque step "
      "with the foot on floors from rigid to soft; motor side and gear output.";
  out.question =
      "How soon is a torque there, at the motor and at the gear's output, and what do gear and ground make "
      "of "
      "it?";
  out.presets = {"paper", "paper"};
  out.takes = {Common::kPreset, Common::kPlant, Common::kSeparate, Common::kOut};
  out.example = "--seed 1 --out report";
  out.in_all = {RobotKind::kLeg};
  out.run = [](const ExperimentInput& in) {
    const StepResponseResult result = run_step_response(in.robot, in.preset, in.sim, in.run, in.parallel);
    return ExperimentOutput{step_response_rows(result), result.simulated_s, {step_response_section(result)}};
  };
  return out;
}

}  // namespace sprung
