#pragma once
/// True friction of one gear and its temperature. Pure. Torques and speeds are output side.
#include "simulation/plant/joint_config.h"

namespace sprung::sim {

class GearFriction {
 public:
  GearFriction(const FrictionConfig& friction, const ThermalConfig& thermal, double ambient_degC) noexcept;

  /// Back to the ambient temperature.
  void reset() noexcept;
  /// False: dry friction is `coulomb` whatever happens and holds rigidly, viscous friction is as configured.
  bool varies() const noexcept;
  bool heats() const noexcept { return thermal_.resistance_K_W > 0.0; }
  bool has_temperature() const noexcept { return heats() || friction_.temperature.per_K > 0.0; }
  double temperature_degC() const noexcept { return temperature_degC_; }

  /// Magnitude of what stops the joint or holds it.
  /// @param direction sign of the present dry friction torque, 0 = none: that of the motion, and at rest that
  /// in which it would begin, which the speed cannot tell.
  double dry_Nm(double speed_rad_s, double gear_output_torque_Nm, double direction) const noexcept;
  double viscous_Nm_s_rad(double direction) const noexcept;
  /// Factor on dry_Nm() where the motor's shaft and the joint stand now; 1 where nothing ripples.
  double ripple(double motor_rad, double joint_rad) const noexcept;
  /// One step later. @param loss_W power that friction took in it.
  void heat(double loss_W, double dt_s) noexcept;

 private:
  double temperature_factor() const noexcept;

  FrictionConfig friction_;
  ThermalConfig thermal_;
  double ambient_degC_;
  double temperature_degC_;
};

}  // namespace sprung::sim
