#pragma once
/// What a motor takes from its terminals, seen from the gear's output: with the plant's true windings, so for
/// experiments alone.
#include <vector>

#include "robots/robot_config.h"
#include "simulation/plant/sim_config.h"
#include "simulation/sim_core.h"

namespace sprung {

struct MotorWinding {
  int actuator = 0;
  int joint = -1;         ///< that it turns and no other does; -1: there is none
  double supply_V = 0.0;  ///< where the plant has no supply of its own
  double copper_V_Nm = 0.0, emf_V_s_rad = 0.0, current_A_Nm = 0.0;

  double voltage_V(double torque_Nm, double speed_rad_s) const noexcept {
    return copper_V_Nm * torque_Nm + emf_V_s_rad * speed_rad_s;
  }
  /// Below 0: it brakes, and gives back. Iron and power stage take nothing.
  double power_W(double torque_Nm, double speed_rad_s) const noexcept {
    return voltage_V(torque_Nm, speed_rad_s) * current_A_Nm * torque_Nm;
  }
};

/// Of actuators whose drive in sim.yaml has a winding. @throws ConfigError as SimCore.
std::vector<MotorWinding> motor_windings(const RobotConfig& robot, const SimOptions& sim);

}  // namespace sprung
