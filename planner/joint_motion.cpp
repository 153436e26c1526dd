#include "planner/joint_motion.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Of a number that was computed from a limit, and of a limit that was written in degrees.
constexpr double kRounding = 1e-9;

bool within(double value, double low, double high) noexcept {
  return value >= low - kRounding && value <= high + kRounding;  // false for NaN
}

bool positive_up_to(double value, double limit) noexcept {
  return value > 0.0 && value <= limit * (1.0 + kRounding);
}

}  // namespace

JointMotion::JointMotion(const RobotConfig& robot)
    : limits_(joint_limits(robot)), held_rad_(robot.joints.size(), 0.0) {
  for (const LegConfig& leg : robot.legs) {
    legs_.push_back(leg.joints);
    fits_message_ = fits_message_ && leg.joints.size() <= Vec3{}.size();
  }
}

const char* JointMotion::validate(const JointRequest& request) const noexcept {
  if (!fits_message_) return "joint moves are for legs of up to three joints";
  if (request.joint < 0 || request.joint >= static_cast<int>(limits_.size()))
    return "this robot has no such joint";
  const JointLimits& limits = limits_[request.joint];
  if (!within(request.target_rad, limits.position_min_rad, limits.position_max_rad))
    return "target is not within the joint's position limits (kept by 0.02 rad)";
  if (!positive_up_to(request.speed_rad_s, limits.speed_rad_s))
    return "speed must be positive and within the joint's speed limit";
  if (!std::isfinite(request.acceleration_rad_s2) ||
      !positive_up_to(request.acceleration_rad_s2, limits.acceleration_rad_s2))
    return "acceleration must be positive and within what the actuator can give its own armature";
  return nullptr;
}

bool JointMotion::hold(const JointState& in) noexcept {
  moving_ = -1;
  bool measured = true;
  for (std::size_t i = 0; i < held_rad_.size(); ++i) {
    held_rad_[i] = in.joints[i].estimated_position_rad;
    measured = measured && std::isfinite(held_rad_[i]);
  }
  return measured;
}

void JointMotion::begin(const JointRequest& request, std::int64_t now_us) noexcept {
  if (moving_ >= 0) held_rad_[moving_] = move_.end_rad();
  moving_ = request.joint;
  began_us_ = now_us;
  move_ = {held_rad_[moving_], request.target_rad, request.speed_rad_s, request.acceleration_rad_s2};
}

void JointMotion::brake(std::int64_t now_us) noexcept {
  if (at_rest(now_us)) return;
  move_ = move_.braked(since_begin_s(now_us));
  began_us_ = now_us;
}

bool JointMotion::at_rest(std::int64_t now_us) const noexcept {
  return moving_ < 0 || since_begin_s(now_us) >= move_.duration_s();
}

void JointMotion::write(std::size_t leg, std::int64_t now_us, DesiredLeg& out) const noexcept {
  out.control_mode = ControlMode::kJoint;
  const std::size_t count = std::min(legs_[leg].size(), out.desired_joint_position_rad.size());
  for (std::size_t j = 0; j < count; ++j) {
    const int joint = legs_[leg][j];
    const JointPoint point = joint == moving_ ? move_.at(since_begin_s(now_us))
                                              : JointPoint{held_rad_[joint], 0.0};
    out.desired_joint_position_rad[j] = point.position_rad;
    out.desired_joint_velocity_rad_s[j] = point.velocity_rad_s;
  }
}

}  // namespace sprung
