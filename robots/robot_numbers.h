#pragma once
/// What the loader asks of a robot.yaml, for tests that must not forget a key.
#include <set>
#include <string>

namespace sprung {

/// Path of every number that load_robot() reads of this robot, "joints[3].position.min"; optional ones that
/// its file does not have too, except below an optional map that is not there.
/// @throws ConfigError as load_robot().
std::set<std::string> robot_numbers(const std::string& robot);

}  // namespace sprung
