#pragma once
/// Temperature of a gear without a sensor: the heat that friction makes (docs/sources.md, facts D2),
/// corrected slowly by how much friction there truly is while the joint moves its own weight and nothing
/// else. Kalman filter of one state. Pure.
///
/// It is the temperature at which the law of robot.yaml gives the friction that is seen: where friction has
/// changed for another reason, it follows that.
#include "model/friction/friction_law.h"
#include "model/friction/thermal_state.h"

namespace sprung {

class TemperatureFilter {
 public:
  TemperatureFilter(const FrictionParameters& law, const ThermalParameters& thermal) noexcept
      : law_(law), thermal_(thermal), state_(thermal) {}

  /// False: robot.yaml has no thermal parameters, and the temperature is not known.
  bool configured() const noexcept { return thermal_.time_constant_s > 0.0; }
  /// At the ambient temperature, known as well as the parameters say.
  void reset() noexcept;
  /// @param friction_Nm, velocity_rad_s whose product heats the gear.
  void predict(double friction_Nm, double velocity_rad_s, double dt_s) noexcept;
  /// @param at motion and load at which friction was seen. @param excess_Nm true friction less the law's.
  void observe(const FrictionInput& at, double excess_Nm, double dt_s) noexcept;

  double temperature_C() const noexcept { return configured() ? state_.temperature_C() : kUnknown; }
  double std_K() const noexcept;
  /// Of the law's friction in this motion, by how well the temperature is known; 0 while not configured.
  double std_Nm(const FrictionInput& at) const noexcept;

 private:
  double by_kelvin_Nm(const FrictionInput& at) const noexcept;

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  FrictionParameters law_;
  ThermalParameters thermal_;
  ThermalState state_;
  double variance_K2_ = 0.0;
};

}  // namespace sprung
