#pragma once
/// A gear as a torque sensor: what it is twisted between motor encoder and link encoder, times its stiffness (facts papers D8). Pure.
#include <limits>

#include "robots/torsion_config.h"

namespace sprung {

struct [[nodiscard]] TorsionTorque {
  double torque_Nm = std::numeric_limits<double>::quiet_NaN();  ///< of the gear on the link
  double std_Nm = std::numeric_limits<double>::infinity();
};

/// @param motor_position_rad, link_position_rad of the joint, by the two encoders. @param motor_angle_rad for the kinematic error.
/// Not finite: no torque.
TorsionTorque torsion_torque(const GearTorsion& gear, double motor_position_rad, double link_position_rad,
                             double motor_angle_rad) noexcept;

/// What the teeth add to the link encoder's reading.
double kinematic_error_rad(const GearTorsion& gear, double motor_angle_rad) noexcept;

/// Two estimates of one torque with independent errors, weighted by inverse variance.
/// @param std_Nm >= 0; infinite: not used. At most one is 0.
TorsionTorque fused(const TorsionTorque& a, const TorsionTorque& b) noexcept;

}  // namespace sprung
