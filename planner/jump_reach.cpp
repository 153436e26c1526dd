#include "planner/jump_reach.h"

#include <cmath>

#include "controller/torque_limits.h"

namespace sprung {
namespace {

constexpr int kSteps = 200;  // a millisecond of a 0.2 s curve

}  // namespace

/// Walks along the curve in joint angles.
struct JumpReach::Leg {
  Leg(const RobotConfig& robot, const LegConfig& leg)
      : kinematics(make_leg_kinematics(leg)), transmission(leg) {
    const auto n = static_cast<Eigen::Index>(leg.joints.size());
    least_rad = most_rad = armature_kg_m2 = middle_rad = JointVector::Zero(n);
    speed_rad_s = torque_Nm = JointVector::Zero(static_cast<Eigen::Index>(leg.actuators.size()));
    for (Eigen::Index i = 0; i < n; ++i) {
      const JointConfig& joint = robot.joints[leg.joints[i]];
      least_rad[i] = joint.position_min_rad + kPositionMargin_rad;
      most_rad[i] = joint.position_max_rad - kPositionMargin_rad;
      middle_rad[i] = 0.5 * (least_rad[i] + most_rad[i]);
      armature_kg_m2[i] = joint.armature_kg_m2;
      const ActuatorConfig& actuator = robot.actuators[leg.actuators[i]];
      speed_rad_s[i] = actuator.speed_limit_rad_s;
      torque_Nm[i] = actuator.torque_limit_Nm;
    }
  }

  const char* validate(const JumpCurve& curve) const noexcept {
    JointVector before = middle_rad;
    JointVector begin = middle_rad;
    for (int k = 0; k <= kSteps; ++k) {
      const FootPoint foot = curve.at(curve.duration_s() * k / kSteps);
      const InverseResult pose = kinematics->inverse(to_eigen(foot.position_m), before);
      const bool within = pose.reachable && (pose.position_rad.array() >= least_rad.array()).all() &&
                          (pose.position_rad.array() <= most_rad.array()).all();
      if (!within) return "the leg's stroke is too short for it";
      if (k == 0) begin = pose.position_rad;
      before = pose.position_rad;
      if (const char* why = validate_drives(foot, pose.position_rad, begin)) return why;
    }
    return nullptr;
  }

  const char* validate_drives(const FootPoint& foot, const JointVector& at_rad,
                              const JointVector& begin_rad) const noexcept {
    const DampedInverse inverse = damped_inverse(kinematics->jacobian(at_rad));
    if (inverse.singular) return "the leg's stroke is too short for it";
    const JointVector joints_rad_s = inverse.matrix.transpose() * to_eigen(foot.velocity_m_s);
    const JointVector drives_rad_s = transmission.actuator_from_joint(joints_rad_s);
    if ((drives_rad_s.array().abs() > speed_rad_s.array()).any())
      return "the drives' speed limit is too low for it";
    const bool pushes = foot.velocity_m_s[2] < 0.0;
    const JointVector way_rad = transmission.actuator_from_joint(at_rad - begin_rad);
    const double work_J = (way_rad.array().abs() * torque_Nm.array()).sum();
    const double rotors_J = 0.5 * (armature_kg_m2.array() * joints_rad_s.array().square()).sum();
    const bool far = way_rad.array().abs().maxCoeff() > kStarted_rad;
    return pushes && far && rotors_J > work_J ? "the drives' torque limit is too low for it" : nullptr;
  }

  /// Before that, a curve that begins with a step of speed would seem to need more work than there can be.
  static constexpr double kStarted_rad = 0.2;

  std::unique_ptr<LegKinematics> kinematics;
  Transmission transmission;
  JointVector least_rad, most_rad, middle_rad, armature_kg_m2;
  JointVector speed_rad_s, torque_Nm;  ///< of the drives
};

JumpReach::JumpReach(const RobotConfig& robot) {
  if (!robot.has_feet()) return;
  for (const LegConfig& leg : robot.legs) legs_.emplace_back(robot, leg);
}

JumpReach::~JumpReach() = default;

const char* JumpReach::validate(const JumpCurve& curve) const noexcept {
  for (const Leg& leg : legs_) {
    if (const char* why = leg.validate(curve)) return why;
  }
  return nullptr;
}

}  // namespace sprung
