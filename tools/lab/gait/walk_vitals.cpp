#include "tools/lab/gait/walk_vitals.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/body_frame.h"

namespace sprung {

VitalsWatch::VitalsWatch(const RobotConfig& robot) noexcept : body_(robot.body), cycle_s_(robot.cycle_s) {}

void VitalsWatch::add(const VitalSigns& now) {
  cycles_ += 1.0;
  result_.watched_s = cycles_ * cycle_s_;
  watch_safety(now);
  watch_fall(now);
  if (!result_.fell) watch_drives(now);
}

void VitalsWatch::watch_fall(const VitalSigns& now) {
  if (now.motion.state == MotionPhase::kFallen) result_.caught = true;
  const bool down = result_.caught || truly_fallen(now.truth, body_);
  if (!down || result_.fell) return;
  result_.fell = true;
  result_.fell_at_s = result_.watched_s;
  if (result_.why.empty()) result_.why = std::string("fell: ") + now.motion.last_transition;
}

void VitalsWatch::watch_safety(const VitalSigns& now) {
  const bool good = now.safety.level == SafetyLevel::kOperational;
  if (operational_ && !good && !result_.fell) {
    ++result_.trips;
    if (result_.why.empty())
      result_.why = std::string(name(now.safety.cause)) + ": " + now.safety.detail.data();
  }
  operational_ = good;
}

void VitalsWatch::watch_drives(const VitalSigns& now) {
  const auto joints = static_cast<double>(now.joints.joints.size());
  for (const EstimatedJoint& joint : now.joints.joints)
    if (joint.status == JointStatus::kSaturated) saturated_ += 1.0;
  result_.saturated_share = saturated_ / (cycles_ * joints);
  for (const TrueJoint& joint : now.truth.joints) {
    result_.fastest_rad_s = std::max(result_.fastest_rad_s, std::abs(joint.true_velocity_rad_s));
    result_.strongest_Nm = std::max(result_.strongest_Nm, std::abs(joint.true_motor_torque_Nm));
  }
}

bool truly_fallen(const SimTruth& truth, const BodyConfig& body) noexcept {
  const Attitude now = attitude(truth.base_quaternion_wxyz);
  if (std::abs(now.roll_rad) > body.fallen_tilt_rad || std::abs(now.pitch_rad) > body.fallen_tilt_rad)
    return true;
  double lowest_m = truth.base_in_world_m[2];
  for (const TrueLeg& leg : truth.legs) lowest_m = std::min(lowest_m, leg.true_foot_in_world_m[2]);
  return truth.base_in_world_m[2] - lowest_m < body.fallen_height_m;
}

}  // namespace sprung
