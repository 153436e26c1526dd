#include "robots/maintenance.h"

namespace sprung {

RobotConfig for_maintenance(RobotConfig robot) {
  robot.hold_to_run = true;
  robot.lowering_s /= kMaintenanceSpeed;
  robot.body.meets_falls = false;  // hands are near: nothing moves fast
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

ActuatorConfig as_built(const RobotConfig& robot, int actuator) {
  ActuatorConfig out = robot.actuators.at(actuator);
  if (!robot.hold_to_run) return out;
  out.speed_limit_rad_s /= kMaintenanceSpeed;
  out.torque_limit_Nm /= kMaintenanceTorque;
  return out;
}

}  // namespace sprung
