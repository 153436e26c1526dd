#include "tools/experiments/step_response.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "planner/foot_move.h"
#include "tools/experiments/parallel.h"

namespace sprung {
namespace {

using namespace step_response;

constexpr std::size_t kKnee = 1;
constexpr double kPaperPeak_ms = 4.75;
constexpr double kEnabled_s = 0.3, kMove_s = 1.0;  // drives on; leg to its length
constexpr double kPress_s = 1.5;                   // compliance, kBefore_N
constexpr double kStep_s = 2.5;
constexpr double kEnd_s = 3.0;
constexpr double kShownBefore_s = 0.02;
constexpr double kThrustWatch_s = 0.12;  // by then the knee pushes no more

/// The planner's part: LEG_COMMAND(k) from JOINT_STATE(k).
class PressingLeg {
 public:
  explicit PressingLeg(double leg_length_m) : leg_length_m_(leg_length_m) {}

  void command(const JointState& in, LegCommand& out) noexcept {
    out.stamp = in.stamp;
    out.used_joint_state_seq = in.stamp.seq;
    if (began_us_ < 0) began_us_ = in.stamp.utime_us;
    const double time_s = 1e-6 * static_cast<double>(in.stamp.utime_us - began_us_);
    if (time_s < kEnabled_s)
      move_ = {in.legs.front().estimated_foot_in_hip_m, {0.0, 0.0, -leg_length_m_}, kMove_s};
    for (DesiredLeg& leg : out.legs) leg = desired(time_s);
  }

 private:
  DesiredLeg desired(double time_s) const noexcept {
    const FootPoint foot = move_.at(std::max(0.0, time_s - kEnabled_s));
    DesiredLeg leg;
    leg.phase = LegPhase::kStand;
    leg.control_mode = ControlMode::kPosition;
    leg.desired_foot_in_hip_m = foot.position_m;
    leg.desired_foot_velocity_m_s = foot.velocity_m_s;
    leg.desired_foot_acceleration_m_s2 = foot.acceleration_m_s2;
    if (time_s < kPress_s - 1e-6) return leg;
    leg.control_mode = ControlMode::kCompliance;
    leg.feedforward_force_N = {0.0, 0.0, time_s < kStep_s - 1e-6 ? kBefore_N : kAfter_N};
    return leg;
  }

  double leg_length_m_;
  std::int64_t began_us_ = -1;
  FootMove move_;
};

RunScript locked_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                        const StepCase& config) {
  const double leg_length_m = robot.preset(preset).stand_length_m;
  RunScript out{robot, preset, sim, {}, std::llround(kEnd_s / robot.cycle_s)};
  out.sim.plant["suspended"] = leg_length_m;
  out.sim.plant["floor_height"] = 0.0;
  out.sim.plant["ground_stiffness"] = config.floor_N_m;
  out.sim.plant["ground_friction"] = 0.0;
  const auto leg = std::make_shared<PressingLeg>(leg_length_m);
  out.command_legs_by = [leg](const JointState& in, LegCommand& command) { leg->command(in, command); };
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

void throw_unless_obeyed(const OperatorReply& reply) {
  if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed)
    throw std::runtime_error(std::string("the robot ") + name(reply.outcome) + " a command: " + reply.reason);
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

std::vector<StepCase> step_cases(const RobotConfig& robot, double leg_length_m) {
  if (robot.legs.size() != 1 || robot.legs.front().kinematics != "two_link")
    throw std::invalid_argument("step_response needs a planar leg, as single_leg is; " + robot.name +
                                " is none");
  const double thigh_m = robot.legs.front().links[0].length_m;
  const double shank_m = robot.legs.front().links[1].length_m;
  const double cosine =
      (thigh_m * thigh_m + leg_length_m * leg_length_m - shank_m * shank_m) / (2.0 * thigh_m * leg_length_m);
  const double lever_m = thigh_m * std::sqrt(1.0 - cosine * cosine);  // of a vertical force about the knee
  return {{"thrust", false, kNaN},
          {"rigid_floor", true, kRigidFloor_N_m},
          {"floor_like_gear", true, kGear_Nm_rad / (lever_m * lever_m)}};
}

StepResponseResult run_step_response(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run) {
  const std::vector<StepCase> cases = step_cases(robot, robot.preset(preset).stand_length_m);
  std::vector<RunScript> scripts;
  StepResponseResult out;
  for (const StepCase& config : cases) {
    scripts.push_back(config.locked ? locked_script(robot, preset, sim, config)
                                    : jump_script(robot, preset, sim, JumpMode::kPosition, 1));
    out.simulated_s += static_cast<double>(scripts.back().cycles) * robot.cycle_s;
  }
  out.cases = parallel_map(
      cases.size(), [&](std::size_t i) { return result_of(cases[i], record(scripts[i], cases[i], run)); });
  return out;
}

std::vector<ReportRow> step_response_rows(const StepResponseResult& result) {
  std::vector<ReportRow> out;
  for (const StepResult& done : result.cases) {
    const std::string prefix =
        done.config.locked ? "step_response." + done.config.name + "." : "step_response.";
    const std::optional<double> paper = done.config.locked ? std::nullopt : std::optional(kPaperPeak_ms);
    out.push_back({prefix + "motor.peak", "ms", done.estimated_motor_side.peak_ms, paper, {}, {}});
    out.push_back({prefix + "motor.t90", "ms", done.estimated_motor_side.t90_ms, {}, {}, {}});
    out.push_back({prefix + "output.peak", "ms", done.output.peak_ms, {}, {}, {}});
    out.push_back({prefix + "output.t90", "ms", done.output.t90_ms, {}, {}, {}});
  }
  return out;
}

}  // namespace sprung
