#include "planner/braking_limit.h"

#include "model/friction/friction_law.h"
#include "model/posed_leg.h"

namespace sprung {
namespace {

constexpr int kTried = 12;
constexpr double kLeastShare = 1.0 / 3.0;
constexpr std::int64_t kStep_us = 4'000;
constexpr int kMostSteps = 250;       // a second: longer than any fall that a leg survives
constexpr double kMotorShare = 0.85;  // of the torque limit; the rest is for what the model does not know

}  // namespace

BrakingLimit::BrakingLimit(const RobotConfig& robot, const LegConfig& leg)
    : kinematics_(make_leg_kinematics(leg)), transmission_(leg) {
  const auto n = static_cast<Eigen::Index>(leg.joints.size());
  middle_rad_ = armature_kg_m2_ = limit_Nm_ = JointVector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const JointConfig& joint = robot.joints[leg.joints[i]];
    middle_rad_[i] = 0.5 * (joint.position_min_rad + joint.position_max_rad);
    armature_kg_m2_[i] = joint.armature_kg_m2;
    limit_Nm_[i] = kMotorShare * robot.actuators[leg.actuators[i]].torque_limit_Nm;
    friction_.push_back(joint.estimated_friction());
  }
}

double BrakingLimit::most_braking_m_s2(const FootFall& fall, double wished_m_s2) const noexcept {
  FootFall tried = fall;
  for (int i = 0; i < kTried; ++i) {
    const double share = 1.0 - (1.0 - kLeastShare) * i / kTried;
    tried.set_braking(share * wished_m_s2);
    if (can_follow(tried)) return share * wished_m_s2;
  }
  return kLeastShare * wished_m_s2;
}

bool BrakingLimit::can_follow(FootFall fall) const noexcept {
  JointVector at_rad = middle_rad_;
  for (int i = 0; i < kMostSteps && !fall.braked(); ++i) {
    fall.step(fall.utime_us() + kStep_us);
    if (!fall.braking()) continue;
    at_rad = kinematics_->inverse(to_eigen(fall.foot().position_m), at_rad).position_rad;
    const JointVector asked_Nm = transmission_.actuator_torque(torque_Nm(fall.foot(), at_rad));
    if ((asked_Nm.array().abs() > limit_Nm_.array()).any()) return false;
  }
  return true;
}

JointVector BrakingLimit::torque_Nm(const FootPoint& foot, const JointVector& position_rad) const noexcept {
  const PosedLeg at = posed(*kinematics_, position_rad);
  const JointVector velocity_rad_s = joint_velocity_rad_s(at, to_eigen(foot.velocity_m_s));
  const JointVector acceleration_rad_s2 = joint_acceleration_rad_s2(
      *kinematics_, at, to_eigen(foot.acceleration_m_s2), velocity_rad_s);
  JointVector torque = kinematics_->inverse_dynamics_Nm(at.pose, velocity_rad_s, acceleration_rad_s2) -
                       kinematics_->gravity_torque_Nm(at.pose);
  for (Eigen::Index j = 0; j < torque.size(); ++j)
    torque[j] += armature_kg_m2_[j] * acceleration_rad_s2[j] +
                 friction_torque_Nm(friction_[static_cast<std::size_t>(j)], {velocity_rad_s[j], torque[j]});
  return torque;
}

}  // namespace sprung
