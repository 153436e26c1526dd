#pragma once
/// Parameters of the friction of one geared joint: one superset, and the named models as subsets of it, so
/// that identification can treat them as a vector and all others as a struct. Pure.
///
/// Joint side, SI. Sign: friction is positive with positive velocity; subtract it from the motor torque.
/// A parameter that is zero switches its term off (exponents: their plain value stands in the struct).
#include <array>
#include <cstddef>

#include "signals/enumeration.h"

namespace sprung {

/// Sources: docs/sources.md, facts D1, D2, D3; the law itself: friction_law.h.
struct FrictionParameters {
  double coulomb_Nm = 0.0;
  double stribeck_Nm = 0.0;  ///< breakaway minus Coulomb, >= 0 (robot.yaml says `breakaway`)
  double stribeck_speed_rad_s = 0.1;
  double stribeck_exponent = 2.0;
  double viscous_Nm_s_rad = 0.0;    ///< of |w|^viscous_exponent, w in rad/s
  double viscous_exponent = 1.0;    ///< below 1: grease that thins with shear
  double load_share_driving = 0.0;  ///< of |gear output torque L| while L w > 0: the motor drives
  double load_share_driven = 0.0;   ///< while L w < 0: the gear is driven back
  double asymmetry = 0.0;           ///< factor 1 + asymmetry sgn(w) on the dry part (all but viscous)
  /// Deflection at which the first stiffness would give full friction; 0 = rigid.
  double presliding_rad = 0.0;
  double viscous_temperature_1_K = 0.0;   ///< beta: viscous * exp(-beta (T - T0))
  double coulomb_temperature_1_K = 0.0;   ///< the same of Coulomb and Stribeck
  double reference_temperature_C = 24.0;  ///< T0; no parameter to fit
};

/// The simplest law: this torque in either direction.
FrictionParameters coulomb_alone(double coulomb_Nm) noexcept;

/// Of one joint's friction against what its law says: its dry part (Coulomb, Stribeck, load) and the viscous.
struct FrictionFactors {
  double dry = 1.0, viscous = 1.0;
};
FrictionParameters scaled(const FrictionParameters& law, const FrictionFactors& by) noexcept;

/// Breakaway torque without load: Coulomb plus Stribeck.
double breakaway_Nm(const FrictionParameters& parameters) noexcept;

/// Index into what identification sees as a vector.
enum class FrictionParameter : std::size_t {
  kCoulomb,
  kStribeck,
  kStribeckSpeed,
  kStribeckExponent,
  kViscous,
  kViscousExponent,
  kLoadShareDriving,
  kLoadShareDriven,
  kAsymmetry,
  kPresliding,
  kViscousTemperature,
  kCoulombTemperature,
};
inline constexpr std::size_t kFrictionParameters = 12;
/// One number for each parameter, in order of FrictionParameter.
using FrictionVector = std::array<double, kFrictionParameters>;

struct FrictionParameterInfo {
  FrictionParameter index;
  const char* name;  ///< in reports, and in robot.yaml (there `breakaway` stands for stribeck)
  const char* unit;  ///< as in robot.yaml; "" = a bare number
  double low;        ///< hard bounds: beyond them the law has no meaning
  double high;
  double off;  ///< value that switches the term off, or leaves it plain
  double FrictionParameters::*member;
};

/// In order of FrictionParameter.
const std::array<FrictionParameterInfo, kFrictionParameters>& friction_parameter_table() noexcept;
const FrictionParameterInfo& info(FrictionParameter parameter) noexcept;

FrictionVector to_vector(const FrictionParameters& parameters) noexcept;

/// Named subsets; each holds all of the one before.
enum class FrictionModelKind {
  kCoulomb,
  kViscous,     ///< Coulomb + viscous
  kStribeck,    ///< + Stribeck
  kLoad,        ///< + load in both directions of power, + asymmetry
  kPresliding,  ///< + generalised Maxwell slip
};
inline constexpr std::array<FrictionModelKind, 5> kFrictionModels = {
    FrictionModelKind::kCoulomb, FrictionModelKind::kViscous, FrictionModelKind::kStribeck,
    FrictionModelKind::kLoad, FrictionModelKind::kPresliding};

/// Words of robot.yaml and of reports.
constexpr auto words_of(FrictionModelKind) {
  using E = FrictionModelKind;
  return words<E>({{E::kCoulomb, "coulomb"},
                   {E::kViscous, "viscous"},
                   {E::kStribeck, "stribeck"},
                   {E::kLoad, "load"},
                   {E::kPresliding, "presliding"}});
}

/// Is the parameter one of this model's? Exponents and temperature factors are of no model by default: they
/// may be added to any that has the term which they shape.
bool has(FrictionModelKind kind, FrictionParameter parameter) noexcept;
/// May it be: the model's own, and what may be added to them.
bool allows(FrictionModelKind kind, FrictionParameter parameter) noexcept;
/// The same with every parameter off that the model does not allow.
FrictionParameters restricted(const FrictionParameters& parameters, FrictionModelKind kind) noexcept;

}  // namespace sprung
