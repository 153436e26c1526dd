#pragma once
/// What the panels of the live page show ten times a second: joints with bounds and limits, feet, drives.
/// Pure.
#include <nlohmann/json_fwd.hpp>

#include "robots/robot_config.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"

namespace sprung::station {

/// What does not change while the robot is up: names, units' limits. Keys robot, joints, legs, actuators,
/// gaits.
nlohmann::ordered_json robot_json(const RobotConfig& robot);

/// Keys joints, legs, actuators: rows in the order of robot_json(). A number that nobody has measured is
/// null. Battery: supply_V of each drive that tells it.
nlohmann::ordered_json live_json(const JointState& joints, const DriveState& drives);

}  // namespace sprung::station
