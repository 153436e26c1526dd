#pragma once
/// A gear as a torque sensor: what it is twisted between motor encoder and link encoder, times its stiffness
/// (docs/sources.md, facts D8). Pure.
#include <limits>

#include "robots/torsion_config.h"

namespace sprung {

struct [[nodiscard]] TorsionTorque {
  double torque_Nm = std::numeric_limits<double>::quiet_NaN();  ///< of the gear on the link
  double std_Nm = std::numeric_limits<double>::infinity();
};

/// Motor angle less link angle of a joint, by its two encoders, what the teeth add removed. NaN where one is.
double twist_rad(const GearTorsion& gear, double motor_position_rad, double link_position_rad,
                 double motor_angle_rad) noexcept;
/// What the teeth add to the link encoder's reading.
double kinematic_error_rad(const GearTorsion& gear, double motor_angle_rad) noexcept;

/// Not finite: no torque.
TorsionTorque torsion_torque(const GearTorsion& gear, double twist_rad, double angle_std_rad) noexcept;
/// The inverse.
double twist_of_rad(const GearTorsion& gear, double torque_Nm) noexcept;

/// Twist that is shown without a load. A zero that was found by the link encoder has in it what the gear was
/// twisted by then and what the teeth added, 7 Nm and more; so it is learned while the joint moves, when the
/// motor's side knows the torque: errors of its friction change sign with the direction, and a zero does not.
class TorsionZero {
 public:
  void reset() noexcept;
  /// @param twist_rad as measured. @param by_torque_rad as the motor's side has it.
  void observe(double twist_rad, double by_torque_rad, double dt_s) noexcept;
  double zero_rad() const noexcept { return zero_rad_; }
  double std_rad() const noexcept;

 private:
  double zero_rad_ = 0.0;
  double variance_rad2_ = 0.0;
};

/// Two estimates of one torque with independent errors, weighted by inverse variance.
/// @param std_Nm >= 0; infinite: not used. At most one is 0.
TorsionTorque fused(const TorsionTorque& a, const TorsionTorque& b) noexcept;

}  // namespace sprung
