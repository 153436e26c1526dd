#include "tools/operate/client/joint_mover.h"

#include <stdexcept>

#include "lcmtypes/channels.h"
#include "planner/joint_limits.h"
#include "runtime/stop_request.h"

namespace sprung {
namespace {

constexpr double kAnswer_s = 3.0;
constexpr double kSilence_s = 5.0;
constexpr double kLook_s = 0.02;
constexpr double kGentleSpeed = 0.1;
constexpr double kGentleRise_s = 0.25;

bool ended(const std::optional<OperatorAnswer>& answer) {
  return !answer ||
         (answer->outcome != OperatorOutcome::kAccepted && answer->outcome != OperatorOutcome::kQueued);
}

}  // namespace

int joint_named(const RobotConfig& robot, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return static_cast<int>(i);
    known += (known.empty() ? "" : ", ") + robot.joints[i].name;
  }
  throw std::invalid_argument("'" + name + "' is no joint of " + robot.name + "; there are: " + known);
}

OperatorCommand gentle_move(const RobotConfig& robot, int joint, double target_rad) {
  OperatorCommand command;
  command.kind = OperatorKind::kMoveJoint;
  command.joint = joint;
  command.joint_target_rad = target_rad;
  command.joint_speed_rad_s = kGentleSpeed * joint_limits(robot)[joint].speed_rad_s;
  command.joint_acceleration_rad_s2 = command.joint_speed_rad_s / kGentleRise_s;
  return command;
}

JointMover::JointMover(const RunInfo& info, const RobotConfig& robot)
    : node_(NodeOptions{info.lcm_url, info.session, info.epoch_us, {}}), client_(info) {
  node_.subscribe(channels::kJointState, CountLimits::exactly(robot.joints.size(), robot.legs.size()),
                  states_);
  node_.start();
}

const JointState* JointMover::look(double timeout_s) {
  const std::int64_t end_us = node_.utime_us() + static_cast<std::int64_t>(1e6 * timeout_s);
  bool any = false;
  do {
    while (auto state = states_.pop()) {
      newest_ = std::move(*state);
      any = true;
    }
    if (!any) node_.wait_for_input(end_us);
  } while (!any && node_.utime_us() < end_us && !stop_requested());
  return any ? &*newest_ : nullptr;
}

std::optional<OperatorAnswer> JointMover::send(OperatorCommand& command) {
  return client_.send(command, kAnswer_s);
}

std::optional<OperatorAnswer> JointMover::follow(const OperatorCommand& command, const Progress& progress) {
  std::int64_t heard_us = node_.utime_us();
  while (!stop_requested() && node_.utime_us() < heard_us + static_cast<std::int64_t>(1e6 * kSilence_s)) {
    if (auto answer = client_.wait_done(command, kLook_s)) return answer;
    const JointState* state = look(0.0);
    if (state == nullptr) continue;
    heard_us = node_.utime_us();
    if (progress) progress(*state);
  }
  return std::nullopt;
}

std::optional<OperatorAnswer> JointMover::carry_out(OperatorCommand& command, const Progress& progress) {
  const std::optional<OperatorAnswer> first = send(command);
  return ended(first) ? first : follow(command, progress);
}

bool JointMover::pause(double seconds) {
  const JointState* state = look(kSilence_s);
  if (state == nullptr) return false;
  const std::int64_t end_us = state->stamp.utime_us + static_cast<std::int64_t>(1e6 * seconds);
  while (state != nullptr && state->safety == SafetyLevel::kOperational) {
    if (state->stamp.utime_us >= end_us) return true;
    state = look(kSilence_s);
  }
  return false;
}

}  // namespace sprung
