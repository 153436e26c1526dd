#pragma once
/// Coulomb friction of a joint (S0 eq. 5, with errata E5: sgn(0) = 0 and a smooth law, not a chattering one).
/// Sign: positive with positive velocity; subtract it from the motor torque.
#include <cmath>

namespace sprung {

/// Below this a joint counts as at rest, where friction takes any value within +-Coulomb. Ten times the
/// velocity noise of a 17-bit motor encoder behind 100:1 (about 1 mrad/s), a tenth of the slowest motion that
/// the papers identify at.
inline constexpr double kRestSpeed_rad_s = 0.01;

struct [[nodiscard]] FrictionEstimate {
  double torque_Nm = 0.0;
  bool at_rest = true;  ///< the torque is then the middle of what is possible, not a measurement
};

/// Coulomb * tanh(velocity / smoothing). smoothing > 0.
inline FrictionEstimate coulomb_friction(double coulomb_Nm, double velocity_rad_s,
                                         double smoothing_rad_s) noexcept {
  return {coulomb_Nm * std::tanh(velocity_rad_s / smoothing_rad_s),
          std::abs(velocity_rad_s) < kRestSpeed_rad_s};
}

/// Steeper than the controller's compensation, since an estimate may follow the sign that a feedback must
/// smooth.
inline constexpr double kPapersSmoothing_rad_s = 0.02;

/// What the papers' "joint torque" subtracts (S0 eq. 6): motor_side_torque_Nm of JOINT_STATE plus this is R
/// Kt i.
inline FrictionEstimate papers_friction(double coulomb_Nm, double velocity_rad_s) noexcept {
  return coulomb_friction(coulomb_Nm, velocity_rad_s, kPapersSmoothing_rad_s);
}

}  // namespace sprung
