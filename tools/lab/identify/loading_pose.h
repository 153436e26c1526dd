#pragma once
/// Where a leg's other joints are held while one is recorded with a weight at the foot, so that the weight
/// loads it: a knee's weight says nothing of a shank that hangs straight down. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/identify/record_protocol.h"

namespace sprung::identify {

struct HeldJoint {
  int joint = -1;  ///< of the robot
  double position_rad = 0.0;
};

/// Of five angles in each other joint's range (record_range()), those with which the foot's horizontal lever
/// about `joint` is largest, RMS over the range in which it is recorded. Empty for legs without kinematics.
/// @throws std::invalid_argument as record_range().
std::vector<HeldJoint> loading_pose(const RobotConfig& robot, int joint);

/// The moves that bring them there, one after the other, gently.
std::vector<RecordMove> loading_moves(const RobotConfig& robot, int joint);

}  // namespace sprung::identify
