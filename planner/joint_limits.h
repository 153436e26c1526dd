#pragma once
/// How far and how fast a joint may be moved by itself, from robot.yaml. Pure.
#include <vector>

#include "robots/robot_config.h"

namespace sprung {

struct JointLimits {
  double position_min_rad = 0.0;  ///< of set-points: kPositionMargin_rad inside robot.yaml's limits
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;          ///< at which the first of its actuators is at its speed limit
  double acceleration_rad_s2 = 0.0;  ///< at which its armature alone takes an actuator's whole torque
};

/// In the order of robot.joints; of a joint that no leg has, all are zero.
/// @throws std::invalid_argument on a transmission that cannot be.
std::vector<JointLimits> joint_limits(const RobotConfig& robot);

}  // namespace sprung
