#pragma once
/// Reads and validates robots/<name>/robot.yaml. Start-up only: throws, allocates, reads files.
#include <stdexcept>
#include <string>

#include "robots/robot_config.h"

namespace sprung {

/// A mistake in a robot file; what() reads "robots/x/robot.yaml:12: key 'a.b': found ..., expected ...".
struct ConfigError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param robot a name (looked up in the robots folder) or a folder that holds robot.yaml.
/// @throws ConfigError on unknown or missing keys, missing or wrong units, values out of range, two drives on
/// one node id.
RobotConfig load_robot(const std::string& robot);

/// The same from the text of a robot.yaml, as a log holds one. Its folder is "". @param name stands for the
/// path in messages.
RobotConfig read_robot_text(const std::string& yaml, const std::string& name);

/// Folder of a robot by name or path: $SPRUNG_ROBOTS, else robots/ beside the program's build tree or the
/// source tree.
/// @throws ConfigError naming the folders looked in and the robots found there.
std::string robot_folder(const std::string& robot);

}  // namespace sprung
