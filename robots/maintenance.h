#pragma once
/// A robot that people work on: `sprung up --maintenance`. Every process of the stack sees the same reduced
/// limits, so that the planner asks for no more than the bridge lets through and the drives are set to. Pure.
#include "robots/robot_config.h"

namespace sprung {

/// [design choice] of robot.yaml's limits. Half of the torque still holds a shipped robot that stands; a
/// quarter of the speed turns pegasus's hips at 1.1 rad/s, and with them a foot half a metre away at 0.55
/// m/s.
inline constexpr double kMaintenanceSpeed = 0.25;
inline constexpr double kMaintenanceTorque = 0.5;
/// [design choice] longest time for which an operator's word holds: `sprung hold` renews it every 0.1 s.
inline constexpr double kLongestHoldToRun_s = 1.0;

/// Lower limits of speed and torque, slower moves, and hold_to_run.
RobotConfig for_maintenance(RobotConfig robot);
/// With robot.yaml's own limits, also of a robot in maintenance: what a measurement can be does not change.
ActuatorConfig as_built(const RobotConfig& robot, int actuator);

}  // namespace sprung
