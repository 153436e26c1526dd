#pragma once
/// Friction of a geared joint: value and derivatives. Pure, no heap.
///
///   f = s (1 + a sgn s) { [Tc + Ts exp(-|w / ws|^p)] exp(-bc dT) + K |L| } + B exp(-bv dT) sgn(w) |w|^n
///
/// w joint velocity, L gear output torque, K the driving share while L s > 0 and the driven one while L s <
/// 0, dT temperature above the reference. s stands for the sign of motion: sgn(w), with sgn(0) = 0 (errata
/// E5), or what is given for it: a presliding state (presliding_state.h), or tanh(w / w0) where a
/// feedback must not chatter. Sources: docs/sources.md, facts D1 (load), facts D2 (temperature), facts C4
/// (asymmetry).
#include <limits>

#include "model/friction/friction_parameters.h"

namespace sprung {

struct FrictionInput {
  double velocity_rad_s = 0.0;
  double gear_output_torque_Nm = 0.0;                               ///< L
  double temperature_C = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the reference temperature
  double sign = std::numeric_limits<double>::quiet_NaN();           ///< s in [-1, 1]; NaN: sgn(velocity)
  double sign_by_presliding_1_rad = 0.0;  ///< derivative of `sign` by presliding_rad, PreslidingState's
};

struct [[nodiscard]] FrictionValue {
  double torque_Nm = 0.0;
  FrictionVector gradient{};          ///< by each parameter, in its own unit
  double by_velocity_Nm_s_rad = 0.0;  ///< at constant sign; 0 at rest, where it need not exist
  double by_load = 0.0;               ///< by the gear output torque
  double by_sign_Nm = 0.0;            ///< by `sign`
};

/// The value alone, without derivatives.
double friction_torque_Nm(const FrictionParameters& parameters, const FrictionInput& in) noexcept;
FrictionValue evaluate(const FrictionParameters& parameters, const FrictionInput& in) noexcept;

/// Value and slope by the load, for who follows both in every cycle.
struct [[nodiscard]] LoadedFriction {
  double torque_Nm = 0.0;
  double by_load = 0.0;     ///< as in FrictionValue
  double viscous_Nm = 0.0;  ///< part of torque_Nm
};
LoadedFriction loaded_friction(const FrictionParameters& parameters, const FrictionInput& in) noexcept;

/// What neither the load nor the sign of motion changes, so that both can be tried (gear_output.h) without
/// the exponentials anew.
struct FrictionAtSpeed {
  double sign = 0.0;        ///< s as given, or sgn(w)
  double dry_Nm = 0.0;      ///< [...] of Coulomb and Stribeck, >= 0
  double viscous_Nm = 0.0;  ///< signed
};
FrictionAtSpeed friction_at_speed(const FrictionParameters& parameters, const FrictionInput& in) noexcept;

/// Parts that do not depend on the load, for who solves for it.
struct FrictionParts {
  double sign = 0.0;        ///< s
  double dry_Nm = 0.0;      ///< (1 + a sgn s)[...] of Coulomb and Stribeck, >= 0
  double viscous_Nm = 0.0;  ///< signed
  double driving = 0.0;     ///< (1 + a sgn s) K
  double driven = 0.0;
};
FrictionParts friction_parts(const FrictionParameters& parameters, const FrictionAtSpeed& at,
                             double sign) noexcept;

}  // namespace sprung
