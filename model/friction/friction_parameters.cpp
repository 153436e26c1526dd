#include "model/friction/friction_parameters.h"

namespace sprung {
namespace {

using P = FrictionParameter;
using S = FrictionParameters;

constexpr std::size_t at(P parameter) noexcept { return static_cast<std::size_t>(parameter); }

/// Load shares end at 0.6, asymmetry at 0.5: beyond 1 / (1 + asymmetry) a driven gear locks itself, which no
/// strain wave gear of such ratios does (facts E13: they can be driven back).
constexpr std::array<FrictionParameterInfo, kFrictionParameters> kTable = {{
    {P::kCoulomb, "coulomb", "Nm", 0.0, 500.0, 0.0, &S::coulomb_Nm},
    {P::kStribeck, "stribeck", "Nm", 0.0, 500.0, 0.0, &S::stribeck_Nm},
    {P::kStribeckSpeed, "stribeck_speed", "rad/s", 1e-4, 100.0, 0.1, &S::stribeck_speed_rad_s},
    {P::kStribeckExponent, "stribeck_exponent", "", 0.5, 4.0, 2.0, &S::stribeck_exponent},
    {P::kViscous, "viscous", "Nm s/rad", 0.0, 1000.0, 0.0, &S::viscous_Nm_s_rad},
    {P::kViscousExponent, "viscous_exponent", "", 0.2, 2.0, 1.0, &S::viscous_exponent},
    {P::kLoadShareDriving, "load_share_driving", "", 0.0, 0.6, 0.0, &S::load_share_driving},
    {P::kLoadShareDriven, "load_share_driven", "", 0.0, 0.6, 0.0, &S::load_share_driven},
    {P::kAsymmetry, "asymmetry", "", -0.5, 0.5, 0.0, &S::asymmetry},
    {P::kPresliding, "presliding", "rad", 0.0, 0.1, 0.0, &S::presliding_rad},
    {P::kViscousTemperature, "viscous_temperature", "1/K", -0.1, 0.1, 0.0, &S::viscous_temperature_1_K},
    {P::kCoulombTemperature, "coulomb_temperature", "1/K", -0.1, 0.1, 0.0, &S::coulomb_temperature_1_K},
}};

/// First model that has the parameter; what shapes a term may be added from the term's model on.
struct Membership {
  FrictionModelKind first;
  bool own;
};

constexpr std::array<Membership, kFrictionParameters> kMembership = {{
    {FrictionModelKind::kCoulomb, true},     // coulomb
    {FrictionModelKind::kStribeck, true},    // stribeck
    {FrictionModelKind::kStribeck, true},    // its speed
    {FrictionModelKind::kStribeck, false},   // its exponent
    {FrictionModelKind::kViscous, true},     // viscous
    {FrictionModelKind::kViscous, false},    // its exponent
    {FrictionModelKind::kLoad, true},        // driving
    {FrictionModelKind::kLoad, true},        // driven
    {FrictionModelKind::kLoad, true},        // asymmetry
    {FrictionModelKind::kPresliding, true},  // presliding
    {FrictionModelKind::kViscous, false},    // temperature on viscous
    {FrictionModelKind::kCoulomb, false},    // temperature on Coulomb
}};

}  // namespace

FrictionParameters coulomb_alone(double coulomb_Nm) noexcept {
  FrictionParameters parameters;
  parameters.coulomb_Nm = coulomb_Nm;
  return parameters;
}

FrictionParameters scaled(const FrictionParameters& law, const FrictionFactors& by) noexcept {
  FrictionParameters out = law;
  out.coulomb_Nm *= by.dry;
  out.stribeck_Nm *= by.dry;
  out.load_share_driving *= by.dry;
  out.load_share_driven *= by.dry;
  out.viscous_Nm_s_rad *= by.viscous;
  return out;
}

double breakaway_Nm(const FrictionParameters& parameters) noexcept {
  return parameters.coulomb_Nm + parameters.stribeck_Nm;
}

const std::array<FrictionParameterInfo, kFrictionParameters>& friction_parameter_table() noexcept {
  return kTable;
}

const FrictionParameterInfo& info(FrictionParameter parameter) noexcept { return kTable[at(parameter)]; }

FrictionVector to_vector(const FrictionParameters& parameters) noexcept {
  FrictionVector vector{};
  for (const FrictionParameterInfo& i : kTable) vector[at(i.index)] = parameters.*(i.member);
  return vector;
}

bool has(FrictionModelKind kind, FrictionParameter parameter) noexcept {
  return kMembership[at(parameter)].own && allows(kind, parameter);
}

bool allows(FrictionModelKind kind, FrictionParameter parameter) noexcept {
  return kind >= kMembership[at(parameter)].first;
}

FrictionParameters restricted(const FrictionParameters& parameters, FrictionModelKind kind) noexcept {
  FrictionParameters out = parameters;
  for (const FrictionParameterInfo& i : kTable) {
    if (!allows(kind, i.index)) out.*(i.member) = i.off;
  }
  return out;
}

}  // namespace sprung
