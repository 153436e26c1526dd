#include "estimator/torsion_sensor.h"

#include <algorithm>
#include <cmath>

namespace sprung {

double kinematic_error_rad(const GearTorsion& gear, double motor_angle_rad) noexcept {
  double error_rad = 0.0;
  for (std::size_t i = 0; i < gear.kinematic_terms; ++i) {
    const KinematicErrorTerm& term = gear.kinematic_error[i];
    const double angle_rad = term.order * motor_angle_rad;
    error_rad += term.cosine_rad * std::cos(angle_rad) + term.sine_rad * std::sin(angle_rad);
  }
  return error_rad;
}

TorsionTorque torsion_torque(const GearTorsion& gear, double motor_position_rad, double link_position_rad,
                             double motor_angle_rad) noexcept {
  const double link_rad = link_position_rad - kinematic_error_rad(gear, motor_angle_rad);
  const double twist_rad = motor_position_rad - link_rad;
  if (!std::isfinite(twist_rad)) return {};
  const bool two = gear.second_from_Nm > 0.0;
  const double soft_rad =
      two ? std::min(std::abs(twist_rad), gear.second_from_Nm / gear.stiffness_Nm_rad) : std::abs(twist_rad);
  const double hard_rad = std::abs(twist_rad) - soft_rad;
  const double torque_Nm = gear.stiffness_Nm_rad * soft_rad + gear.second_stiffness_Nm_rad * hard_rad;
  const double slope_Nm_rad = hard_rad > 0.0 ? gear.second_stiffness_Nm_rad : gear.stiffness_Nm_rad;
  return {std::copysign(torque_Nm, twist_rad), slope_Nm_rad * gear.angle_std_rad};
}

TorsionTorque fused(const TorsionTorque& a, const TorsionTorque& b) noexcept {
  if (!std::isfinite(b.torque_Nm) || !std::isfinite(b.std_Nm)) return a;
  if (!std::isfinite(a.torque_Nm) || !std::isfinite(a.std_Nm)) return b;
  const double share_of_b = a.std_Nm * a.std_Nm / (a.std_Nm * a.std_Nm + b.std_Nm * b.std_Nm);
  return {a.torque_Nm + share_of_b * (b.torque_Nm - a.torque_Nm), std::sqrt(share_of_b) * b.std_Nm};
}

}  // namespace sprung
