#include "controller/compliance_law.h"

#include <cmath>

namespace sprung {

JointVector compliance_torque_Nm(const LegKinematics& kinematics, const DesiredLeg& desired,
                                 const FootMotion& foot, const LegMotion& leg,
                                 const FrictionCompensation& friction) noexcept {
  const LegJacobian jacobian = kinematics.jacobian(leg.position_rad);
  const Eigen::Vector3d error_m = foot.position_m - kinematics.foot_in_hip_m(leg.position_rad);
  const Eigen::Vector3d slip_m_s =
      desired.velocity_feedforward * foot.velocity_m_s - jacobian * leg.velocity_rad_s;
  const Eigen::Vector3d force_N = to_eigen(desired.stiffness_N_m).cwiseProduct(error_m) +
                                  to_eigen(desired.damping_N_s_m).cwiseProduct(slip_m_s) -
                                  to_eigen(desired.feedforward_force_N);
  JointVector torque = jacobian.transpose() * force_N + kinematics.gravity_torque_Nm(leg.position_rad);
  for (int j = 0; j < torque.size(); ++j) {
    const double w = leg.velocity_rad_s[j];
    const FrictionInput in{w, torque[j], leg.temperature_C[j], std::tanh(w / friction.smoothing_rad_s)};
    torque[j] +=
        desired.friction_compensation * friction_torque_Nm(friction.joints[static_cast<std::size_t>(j)], in);
  }
  return torque;
}

}  // namespace sprung
