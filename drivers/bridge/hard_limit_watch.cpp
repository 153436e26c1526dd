#include "drivers/bridge/hard_limit_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/bridge/safety_machine.h"

namespace sprung {
namespace {

// [design choice] A robot's own stops stand 0.05 rad beyond its limits, and a leg that is pushed leans on
// them (sprung experiment push --robot pegasus --seed 2): further out the position is not what is measured.
constexpr double kBeyond_rad = 0.08;
constexpr double kFurther_rad = 0.02;
/// A push may throw a joint into its stop, which springs back.
constexpr std::int64_t kBeyond_us = 30'000;
constexpr double kOverspeedShare = 1.2;
constexpr std::int64_t kFast_us = 20'000;

double beyond_rad(const JointConfig& joint, double position_rad) noexcept {
  return std::max({0.0, joint.position_min_rad - position_rad, position_rad - joint.position_max_rad});
}

}  // namespace

HardLimitWatch::HardLimitWatch(const RobotConfig& robot) {
  for (const ActuatorConfig& actuator : robot.actuators)
    drives_.push_back({actuator.name, actuator.speed_limit_rad_s});
  for (const LegConfig& leg : robot.legs) {
    std::vector<Joint> joints;
    for (const int joint : leg.joints) joints.push_back({robot.joints.at(joint)});
    legs_.push_back({Transmission(leg), leg.actuators, joints});
  }
}

void HardLimitWatch::judge(const std::vector<GateMotion>& motion, std::int64_t time_us) noexcept {
  any_ = false;
  for (Leg& leg : legs_) judge_leg(leg, motion, time_us);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    drive.velocity_rad_s = motion[i].filtered_velocity_rad_s;
    const bool faster = motion[i].enabled && drive.limit_rad_s > 0.0 &&
                        std::abs(drive.velocity_rad_s) > kOverspeedShare * drive.limit_rad_s;
    if (!faster) drive.slow_us = time_us;
    drive.fast = time_us - drive.slow_us >= kFast_us;
    any_ = any_ || drive.fast;
  }
}

void HardLimitWatch::judge_leg(Leg& leg, const std::vector<GateMotion>& motion,
                               std::int64_t time_us) noexcept {
  JointVector measured_rad(leg.transmission.size());
  for (int i = 0; i < leg.transmission.size(); ++i)
    measured_rad[i] = motion[leg.actuators[i]].measured_position_rad;
  for (int j = 0; j < leg.transmission.size(); ++j) {
    bool powered = false;
    for (int i = 0; i < leg.transmission.size(); ++i)
      powered = powered || (leg.transmission.couples(j, i) && motion[leg.actuators[i]].enabled);
    judge_joint(leg.joints[j], leg.transmission.joint_from_coupled(j, measured_rad), powered, time_us);
    any_ = any_ || leg.joints[j].beyond;
  }
}

void HardLimitWatch::judge_joint(Joint& joint, double position_rad, bool powered,
                                 std::int64_t time_us) noexcept {
  const double now_rad = beyond_rad(joint.config, position_rad);
  if (!powered) joint.allowed_rad = std::numeric_limits<double>::infinity();
  if (!(now_rad > joint.allowed_rad)) joint.inside_us = time_us;
  joint.beyond = time_us - joint.inside_us >= kBeyond_us;
  if (!powered || !std::isfinite(position_rad)) return;
  joint.position_rad = position_rad;
  joint.allowed_rad = std::min(joint.allowed_rad, std::max(kBeyond_rad, now_rad + kFurther_rad));
}

bool HardLimitWatch::fault(Fault& out) const noexcept {
  if (!any_) return false;
  for (const Leg& leg : legs_) {
    for (std::size_t j = 0; j < leg.joints.size(); ++j) {
      const Joint& joint = leg.joints[j];
      if (!joint.beyond) continue;
      out.cause = SafetyCause::kJointLimit;
      out.actuator = leg.actuators[j];
      print(out.detail, "%s: at %.3g rad, beyond its limits of %.3g to %.3g rad", joint.config.name.c_str(),
            joint.position_rad, joint.config.position_min_rad, joint.config.position_max_rad);
      return true;
    }
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const Drive& drive = drives_[i];
    if (!drive.fast) continue;
    out.cause = SafetyCause::kOverspeed;
    out.actuator = static_cast<int>(i);
    print(out.detail, "%s: %.1f rad/s for 20 ms, its limit is %.1f rad/s", drive.name.c_str(),
          drive.velocity_rad_s, drive.limit_rad_s);
    return true;
  }
  return false;
}

}  // namespace sprung
