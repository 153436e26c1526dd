#include "tools/lab/identify/record_session.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "runtime/stop_request.h"
#include "tools/lab/identify/loading_pose.h"

namespace sprung::identify {
namespace {

constexpr double kLook_s = 2.0;
/// Of the robot's time: estimates settle within some ten cycles.
constexpr std::int64_t kStarting_us = 1'000'000;

/// Who asks right after `sprung up` meets joints whose estimates still settle, and waits for them.
const JointState* look_settled(JointMover& mover) {
  const auto starts = [](const EstimatedJoint& joint) { return joint.status == JointStatus::kStarting; };
  const JointState* state = mover.look(kLook_s);
  const std::int64_t until_us = state == nullptr ? 0 : state->stamp.utime_us + kStarting_us;
  while (state != nullptr && state->stamp.utime_us < until_us &&
         std::any_of(state->joints.begin(), state->joints.end(), starts))
    state = mover.look(kLook_s);
  return state;
}

void require_ready(const RobotConfig& robot, const JointState& state) {
  if (state.safety != SafetyLevel::kOperational)
    throw std::runtime_error(
        "safety is not operational: sprung status names the cause, sprung clear recovers");
  for (std::size_t i = 0; i < state.joints.size(); ++i) {
    const JointStatus status = state.joints[i].status;
    if (status == JointStatus::kNotReferenced)
      throw std::runtime_error(robot.joints[i].name + " is not referenced: sprung home");
    if (status != JointStatus::kOk && status != JointStatus::kSaturated)
      throw std::runtime_error(robot.joints[i].name + " is not ready, it is " + name(status) +
                               ": see sprung status");
  }
}

/// nullopt: it was done.
std::optional<std::string> trouble(const std::optional<OperatorAnswer>& answer) {
  if (stop_requested()) return "stopped by the operator";
  if (!answer) return "the robot does not answer any more: see sprung status";
  if (answer->outcome == OperatorOutcome::kDone) return std::nullopt;
  return std::string("a move ") + name(answer->outcome) + ": " + answer->reason;
}

std::optional<std::string> carry_out_moves(const RecordPlan& plan, JointMover& mover,
                                           const std::function<void(const std::string&)>& tell) {
  std::set<RecordPart> begun;
  for (const RecordMove& move : plan.moves) {
    if (begun.insert(move.part).second) tell(name(move.part));
    OperatorCommand command;
    command.kind = OperatorKind::kMoveJoint;
    command.joint = move.joint < 0 ? plan.joint : move.joint;
    command.joint_target_rad = move.target_rad;
    command.joint_speed_rad_s = move.speed_rad_s;
    command.joint_acceleration_rad_s2 = move.acceleration_rad_s2;
    if (auto why = trouble(mover.carry_out(command))) return why;
    if (!mover.pause(move.pause_s))
      return stop_requested() ? "stopped by the operator" : "safety was lost: see sprung status";
  }
  return std::nullopt;
}

}  // namespace

RecordPlan plan_recording(const RobotConfig& robot, int joint, const RecordOptions& options,
                          JointMover& mover) {
  const JointState* state = look_settled(mover);
  if (state == nullptr) throw std::runtime_error("no JOINT_STATE comes in: see sprung status");
  require_ready(robot, *state);
  RecordPlan plan;
  plan.joint = joint;
  plan.range = narrowed(record_range(robot, joint), options.asked);
  plan.from_rad = state->joints[joint].estimated_position_rad;
  if (options.loaded) plan.moves = loading_moves(robot, joint);
  for (const RecordMove& move : record_protocol(plan.range, plan.from_rad, options))
    plan.moves.push_back(move);
  return plan;
}

std::string describe(const RobotConfig& robot, const RecordPlan& plan) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%s moves between %.2f and %.2f rad (it is at %.2f), with at most %.2g rad/s and %.2g rad/s^2, for "
      "about %.0f s. All other joints are held where they are.",
      robot.joints[plan.joint].name.c_str(), plan.range.low_rad, plan.range.high_rad, plan.from_rad,
      plan.range.speed_rad_s, plan.range.acceleration_rad_s2, duration_s(plan.moves, plan.from_rad));
  return text;
}

SessionResult carry_out(const RecordPlan& plan, JointMover& mover,
                        const std::function<void(const std::string&)>& tell) {
  const std::optional<std::string> why = carry_out_moves(plan, mover, tell);
  if (why) tell(*why + "; letting go");
  clear_stop_request();  // the robot is to be let go, whoever wanted it stopped
  OperatorCommand sit;
  sit.kind = OperatorKind::kSit;
  const auto let_go = trouble(mover.carry_out(sit));
  if (why || !let_go) return {!why, why.value_or("")};
  return {false, "the robot was not let go: " + *let_go + ". To switch it off: sprung estop"};
}

}  // namespace sprung::identify
