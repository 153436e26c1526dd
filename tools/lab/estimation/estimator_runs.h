#pragma once
/// Runs of the simulated robot, and how well JOINT_STATE knew the gears' output torques in them.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/estimation/estimator_score.h"

namespace sprung {

/// One for each joint, in the robot's order.
struct JumpScores {
  std::vector<TorqueScore> push_off;
  std::vector<TorqueScore> landing;
  std::vector<TorqueScore> jump;  ///< push-off, flight and landing
  std::vector<TorqueScore>
      rest;  ///< before and after, while the estimate says that friction's sign is unknown

  explicit JumpScores(std::size_t joints) : push_off(joints), landing(joints), jump(joints), rest(joints) {}
  void add(const JumpScores& other);
};

/// Stand, one hybrid jump, stand again, in process. @throws std::runtime_error where it did not jump and
/// land.
JumpScores score_jump(const RobotConfig& robot, const std::string& preset, const SimOptions& sim);

/// @throws std::invalid_argument where the robot has no joint of that name.
std::size_t joint_index(const RobotConfig& robot, const std::string& name);

}  // namespace sprung
