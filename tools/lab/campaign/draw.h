#pragma once
/// What one run of a campaign is: the robot's state, a plant, and what goes wrong. Pure; the same seed and
/// number give the same on every machine.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/campaign/injection.h"

namespace sprung::campaign {

struct Draw {
  std::uint64_t seed = 1;  ///< of the campaign
  std::uint64_t number = 0;
  Class only = Class::kNone;  ///< that it was drawn from; kNone: every class
  std::string state;          ///< of states_of()
  double wait_s = 0.0;        ///< in that state, before the first injection
  SimOptions sim;
  /// One or two; at_seq is the number of cycles after the state was reached. The second one's begins behind
  /// the first one's, or with the clear.
  std::vector<Injection> injections;
  bool second_while_clearing = false;
};

/// "rising", "standing", "comply", each gait, each phase of a jump, "sitting", "clearing", and "homing" where
/// robot.yaml has a way to.
std::vector<std::string> states_of(const RobotConfig& robot);

/// @param only every injection is of this class; Class::kNone: any class.
Draw draw_run(const RobotConfig& robot, std::uint64_t seed, std::uint64_t number, Class only);

}  // namespace sprung::campaign
