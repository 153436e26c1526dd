#include "model/friction/friction_law.h"

#include <cmath>

namespace sprung {
namespace {

using P = FrictionParameter;

double sign_of(double value) noexcept { return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0; }

/// exp(-x). Most laws have no temperature in them, and at rest there is nothing to fall: then it is 1 without
/// being worked out.
double decay(double x) noexcept { return x == 0.0 ? 1.0 : std::exp(-x); }

/// What value and derivatives have in common.
struct Terms {
  Terms(const FrictionParameters& p, const FrictionInput& in) noexcept {
    speed = std::abs(in.velocity_rad_s);
    s = std::isnan(in.sign) ? sign_of(in.velocity_rad_s) : in.sign;
    direction = 1.0 + p.asymmetry * sign_of(s);
    dT = std::isnan(in.temperature_C) ? 0.0 : in.temperature_C - p.reference_temperature_C;
    cool_dry = decay(p.coulomb_temperature_1_K * dT);
    cool_viscous = decay(p.viscous_temperature_1_K * dT);
    ratio = speed / p.stribeck_speed_rad_s;
    power = p.stribeck_exponent == 2.0 ? ratio * ratio : std::pow(ratio, p.stribeck_exponent);
    stribeck = decay(power);
    shear = p.viscous_exponent == 1.0 ? speed : std::pow(speed, p.viscous_exponent);
    moving = sign_of(in.velocity_rad_s);
    load = std::abs(in.gear_output_torque_Nm);
    drives = in.gear_output_torque_Nm * s > 0.0;
    dry_Nm = (p.coulomb_Nm + p.stribeck_Nm * stribeck) * cool_dry;
    share = drives ? p.load_share_driving : p.load_share_driven;
    viscous_Nm = p.viscous_Nm_s_rad * cool_viscous * moving * shear;
  }
  double speed, s, direction, dT, cool_dry, cool_viscous;
  double ratio, power, stribeck, shear, moving, load;
  bool drives;
  double dry_Nm, share, viscous_Nm;

  double total() const noexcept { return s * direction * (dry_Nm + share * load) + viscous_Nm; }
  double by_load(double gear_output_torque_Nm) const noexcept {
    return s * direction * share * sign_of(gear_output_torque_Nm);
  }
};

void write_dry(const FrictionParameters& p, const Terms& t, FrictionVector& g) noexcept {
  const auto set = [&g](P parameter, double value) { g[static_cast<std::size_t>(parameter)] = value; };
  const double dry = t.s * t.direction * t.cool_dry;
  const double fall_Nm = dry * p.stribeck_Nm * t.stribeck * t.power;  // by -log of the exponent's argument
  set(P::kCoulomb, dry);
  set(P::kStribeck, dry * t.stribeck);
  set(P::kStribeckSpeed, fall_Nm * p.stribeck_exponent / p.stribeck_speed_rad_s);
  set(P::kStribeckExponent, t.ratio > 0.0 ? -fall_Nm * std::log(t.ratio) : 0.0);
  set(P::kLoadShareDriving, t.drives ? t.s * t.direction * t.load : 0.0);
  set(P::kLoadShareDriven, t.drives ? 0.0 : t.s * t.direction * t.load);
  set(P::kAsymmetry, t.s * sign_of(t.s) * (t.dry_Nm + t.share * t.load));
  set(P::kCoulombTemperature, -t.dT * t.s * t.direction * t.dry_Nm);
}

void write_viscous(const Terms& t, FrictionVector& g) noexcept {
  g[static_cast<std::size_t>(P::kViscous)] = t.cool_viscous * t.moving * t.shear;
  g[static_cast<std::size_t>(P::kViscousExponent)] = t.speed > 0.0 ? t.viscous_Nm * std::log(t.speed) : 0.0;
  g[static_cast<std::size_t>(P::kViscousTemperature)] = -t.dT * t.viscous_Nm;
}

}  // namespace

double friction_torque_Nm(const FrictionParameters& parameters, const FrictionInput& in) noexcept {
  return Terms(parameters, in).total();
}

FrictionValue evaluate(const FrictionParameters& p, const FrictionInput& in) noexcept {
  const Terms t(p, in);
  FrictionValue out;
  out.torque_Nm = t.total();
  write_dry(p, t, out.gradient);
  write_viscous(t, out.gradient);
  if (t.speed > 0.0) {
    const double fall_Nm = p.stribeck_Nm * t.stribeck * t.cool_dry * p.stribeck_exponent * t.power;
    out.by_velocity_Nm_s_rad = (p.viscous_exponent * t.viscous_Nm * t.moving -
                                t.s * t.moving * t.direction * fall_Nm) /
                               t.speed;
  }
  out.by_load = t.by_load(in.gear_output_torque_Nm);
  out.by_sign_Nm = t.direction * (t.dry_Nm + t.share * t.load);
  out.gradient[static_cast<std::size_t>(FrictionParameter::kPresliding)] = out.by_sign_Nm *
                                                                           in.sign_by_presliding_1_rad;
  return out;
}

LoadedFriction loaded_friction(const FrictionParameters& p, const FrictionInput& in) noexcept {
  const Terms t(p, in);
  return {t.total(), t.by_load(in.gear_output_torque_Nm), t.viscous_Nm};
}

FrictionAtSpeed friction_at_speed(const FrictionParameters& p, const FrictionInput& in) noexcept {
  const Terms t(p, in);
  return {t.s, t.dry_Nm, t.viscous_Nm};
}

FrictionParts friction_parts(const FrictionParameters& p, const FrictionAtSpeed& at, double sign) noexcept {
  const double direction = 1.0 + p.asymmetry * sign_of(sign);
  return {sign, direction * at.dry_Nm, at.viscous_Nm, direction * p.load_share_driving,
          direction * p.load_share_driven};
}

}  // namespace sprung
