#pragma once
/// Coulomb friction of a joint as the papers subtract it (docs/sources.md: S0 eq. 5, with errata E5: nothing
/// at rest, and a smooth law, not a chattering one). Sign: positive with positive velocity; subtract it from
/// the motor torque.
#include <cmath>

namespace sprung {

/// Below this a joint counts as at rest, where friction takes any value within +-Coulomb. Ten times the
/// velocity noise of a 17-bit motor encoder behind 100:1 (about 1 mrad/s), a tenth of the slowest motion that
/// the papers identify at.
inline constexpr double kRestSpeed_rad_s = 0.01;

/// Steeper than the controller's compensation, since an estimate may follow the sign that a feedback must
/// smooth.
inline constexpr double kPapersSmoothing_rad_s = 0.02;

/// What the papers' "joint torque" subtracts from R Kt i (S0 eq. 6): JOINT_STATE's motor_side_torque_Nm is
/// measured_motor_torque_Nm less this.
inline double papers_friction_Nm(double coulomb_Nm, double velocity_rad_s) noexcept {
  return coulomb_Nm * std::tanh(velocity_rad_s / kPapersSmoothing_rad_s);
}

}  // namespace sprung
