#include "controller/compliance_law.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Of a joint whose friction is to be compensated.
struct Moment {
  double velocity_rad_s;
  double spring_Nm;  ///< of the virtual spring alone
  double load_Nm;    ///< that the gear is to put out
  double temperature_C;
};

/// Share of the share `wanted` that acts in motion.
double sure_share(const JointCompensation& joints, std::size_t j, double wanted) noexcept {
  if (j >= joints.friction_uncertainty.size()) return 1.0;
  const double surely = std::max(0.0, 1.0 - joints.friction_uncertainty[j]);
  return wanted > surely ? surely / wanted : 1.0;
}

double rest_friction_Nm(const FrictionParameters& law, const Moment& at, double sign) noexcept {
  return friction_torque_Nm(law, {0.0, at.load_Nm, at.temperature_C, sign});
}

double friction_compensation_Nm(const JointCompensation& joints, std::size_t j, double wanted,
                                const Moment& at) noexcept {
  const FrictionParameters& law = joints.friction[j];
  const double w = at.velocity_rad_s;
  const FrictionInput moving{w, at.load_Nm, at.temperature_C, std::tanh(w / joints.smoothing_rad_s)};
  const double in_motion_Nm = friction_torque_Nm(law, moving);
  if (joints.rest.speed_rad_s <= 0.0) return wanted * in_motion_Nm;
  const double ratio = w / joints.rest.speed_rad_s;
  const double share = std::exp(-ratio * ratio);
  const double resting_Nm = rest_friction_Nm(law, at, std::tanh(at.spring_Nm / joints.rest.torque_Nm));
  const double stuck = j < joints.stuck_share.size() ? joints.stuck_share[j] : 0.0;
  return (wanted + stuck) * share * resting_Nm +
         wanted * (1.0 - share) * sure_share(joints, j, wanted) * in_motion_Nm;
}

}  // namespace

JointVector led_torque_Nm(const LegKinematics& kinematics, const PosedLeg& at, const DesiredLeg& desired,
                          const FootMotion& foot, const LegMotion& leg,
                          const JointCompensation& joints) noexcept {
  const JointVector acceleration = joint_acceleration_rad_s2(kinematics, at, foot.acceleration_m_s2,
                                                             leg.velocity_rad_s);
  JointVector torque = kinematics.inverse_dynamics_Nm(at.pose, leg.velocity_rad_s, acceleration);
  for (int j = 0; j < torque.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const double w = leg.velocity_rad_s[j];
    const FrictionInput moving{w, torque[j], leg.temperature_C[j], std::tanh(w / joints.smoothing_rad_s)};
    const double armature_kg_m2 = joints.armature_kg_m2.empty() ? 0.0 : joints.armature_kg_m2[place];
    const double share = desired.friction_compensation *
                         sure_share(joints, place, desired.friction_compensation);
    torque[j] += share * friction_torque_Nm(joints.friction[place], moving) +
                 desired.inertia_compensation * armature_kg_m2 * acceleration[j];
  }
  return torque;
}

ComplianceTorque compliance_torque(const LegKinematics& kinematics, const DesiredLeg& desired,
                                   const FootMotion& foot, const LegMotion& leg,
                                   const JointCompensation& joints) noexcept {
  const LegPose pose = kinematics.pose(leg.position_rad);
  const LegJacobian jacobian = kinematics.jacobian(pose);
  const Eigen::Vector3d error_m = foot.position_m - kinematics.foot_in_hip_m(pose);
  const Eigen::Vector3d slip_m_s = desired.velocity_feedforward * foot.velocity_m_s -
                                   jacobian * leg.velocity_rad_s;
  const Eigen::Vector3d spring_N = to_eigen(desired.stiffness_N_m).cwiseProduct(error_m);
  const Eigen::Vector3d force_N = spring_N + to_eigen(desired.damping_N_s_m).cwiseProduct(slip_m_s) -
                                  to_eigen(desired.feedforward_force_N);
  ComplianceTorque out;
  out.spring_torque_Nm = jacobian.transpose() * spring_N;
  out.torque_Nm = jacobian.transpose() * force_N + kinematics.gravity_torque_Nm(pose);
  out.rest_friction_Nm = out.torque_Nm;  // of its size
  for (int j = 0; j < out.torque_Nm.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const Moment at{leg.velocity_rad_s[j], out.spring_torque_Nm[j], out.torque_Nm[j], leg.temperature_C[j]};
    out.torque_Nm[j] += friction_compensation_Nm(joints, place, desired.friction_compensation, at);
    out.rest_friction_Nm[j] = rest_friction_Nm(joints.friction[place], at, 1.0);
  }
  if (desired.inertia_compensation == 0.0 || joints.armature_kg_m2.empty()) return out;
  const JointVector acceleration = joint_acceleration_rad_s2(kinematics, {pose, damped_inverse(jacobian)},
                                                             foot.acceleration_m_s2, leg.velocity_rad_s);
  for (int j = 0; j < out.torque_Nm.size(); ++j)
    out.torque_Nm[j] += desired.inertia_compensation * joints.armature_kg_m2[j] * acceleration[j];
  return out;
}

}  // namespace sprung
