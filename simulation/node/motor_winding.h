#pragma once
/// What voltage allows: the current that a supply can drive through a winding against its back-EMF, and the
/// power that this takes from the supply. Pure; motor side, in the motor's own forward direction.
#include "simulation/plant/sim_config.h"

namespace sprung::sim {

/// At the winding's terminals, now.
struct WindingState {
  double voltage_V = 0.0;
  double power_W = 0.0;  ///< from the supply: copper's loss and mechanical power; negative: it brakes
};

/// u = R i + Ke w (facts D12): the inductance is the current loop's lag.
class MotorWinding {
 public:
  /// A drive without `winding` reaches every current and takes no power.
  /// @param limits false: the state is told, but every current can be reached.
  MotorWinding(const SimDriveConfig& truth, double gear_ratio, bool limits) noexcept;

  /// Once a tick. @param shaft_rad_s true speed at the gear's output. @param share of the winding's flux
  /// along its current, 1 where it is commutated well.
  void turn(double shaft_rad_s, double share) noexcept;
  /// The set-point, or what voltage lets through of it: turned too fast, that is a current that brakes.
  double reachable_A(double target_A, double supply_V) const noexcept;
  WindingState state(double current_A) const noexcept;

 private:
  double resistance_ohm_ = 0.0;  ///< 0: not known
  double back_emf_V_s_rad_ = 0.0;
  double voltage_share_ = 1.0;
  double gear_ratio_ = 1.0;
  bool limits_ = false;
  double emf_V_ = 0.0;
};

}  // namespace sprung::sim
