#include "robots/maintenance.h"

namespace sprung {

RobotConfig for_maintenance(RobotConfig robot) {
  robot.hold_to_run = true;
  for (ActuatorConfig& actuator : robot.actuators) {
    actuator.speed_limit_rad_s *= kMaintenanceSpeed;
    actuator.torque_limit_Nm *= kMaintenanceTorque;
  }
  for (PresetConfig& preset : robot.presets) {
    preset.rise_time_s /= kMaintenanceSpeed;
    preset.recover_time_s /= kMaintenanceSpeed;
  }
  return robot;
}

}  // namespace sprung
