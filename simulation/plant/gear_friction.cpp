#include "simulation/plant/gear_friction.h"

#include <cmath>

namespace sprung::sim {

GearFriction::GearFriction(const FrictionConfig& friction, const ThermalConfig& thermal,
                           double ambient_degC) noexcept
    : friction_(friction), thermal_(thermal), ambient_degC_(ambient_degC), temperature_degC_(ambient_degC) {}

void GearFriction::reset() noexcept { temperature_degC_ = ambient_degC_; }

bool GearFriction::varies() const noexcept {
  const bool with_load = friction_.driving_share > 0.0 || friction_.back_driving_share > 0.0;
  return with_load || friction_.breakaway_Nm > friction_.coulomb_Nm || friction_.asymmetry != 0.0 ||
         friction_.temperature.per_K > 0.0 || friction_.motor_ripple.share > 0.0 ||
         friction_.joint_ripple.share > 0.0 || friction_.presliding_rad > 0.0;
}

double GearFriction::temperature_factor() const noexcept {
  const FrictionTemperatureConfig& by = friction_.temperature;
  if (by.per_K == 0.0) return 1.0;
  return std::exp(-by.per_K * (temperature_degC_ - by.reference_degC));
}

double GearFriction::dry_Nm(double speed_rad_s, double gear_output_torque_Nm,
                            double direction) const noexcept {
  const double speed = speed_rad_s / friction_.stribeck_speed_rad_s;
  const double stribeck_Nm = (friction_.breakaway_Nm - friction_.coulomb_Nm) * std::exp(-speed * speed);
  const bool driving = gear_output_torque_Nm * direction > 0.0;
  const double share = driving ? friction_.driving_share : friction_.back_driving_share;
  const double load_Nm = share * std::abs(gear_output_torque_Nm);
  const double warm = friction_.temperature.coulomb_share;
  const double by_temperature = 1.0 + warm * (temperature_factor() - 1.0);
  return (1.0 + friction_.asymmetry * direction) *
         ((friction_.coulomb_Nm + stribeck_Nm) * by_temperature + load_Nm);
}

double GearFriction::viscous_Nm_s_rad(double direction) const noexcept {
  return (1.0 + friction_.asymmetry * direction) * friction_.viscous_Nm_s_rad * temperature_factor();
}

double GearFriction::ripple(double motor_rad, double joint_rad) const noexcept {
  const auto factor = [](const RippleConfig& ripple, double angle_rad) {
    return ripple.share > 0.0 ? 1.0 + ripple.share * std::sin(ripple.order * angle_rad + ripple.phase_rad)
                              : 1.0;
  };
  return factor(friction_.motor_ripple, motor_rad) * factor(friction_.joint_ripple, joint_rad);
}

void GearFriction::heat(double loss_W, double dt_s) noexcept {
  const double warmer_K = loss_W * thermal_.resistance_K_W - (temperature_degC_ - ambient_degC_);
  temperature_degC_ += dt_s / thermal_.time_constant_s * warmer_K;
}

}  // namespace sprung::sim
