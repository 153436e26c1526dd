#pragma once
/// Reads and validates robots/<name>/robot.yaml. Start-up only: throws, allocates, reads files.
#include <map>
#include <string>

#include "robots/config_error.h"
#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung {

/// @param robot a name (looked up in the robots folder) or a folder that holds robot.yaml.
/// @throws ConfigError on unknown or missing keys, missing or wrong units, values out of range, two drives on
/// one node id.
RobotConfig load_robot(const std::string& robot);

/// The same with other numbers, each by its way in robot.yaml and in the unit that the file gives it:
/// {"presets.best.compliance.stiffness.z", 3500}. The files stay as they are. Its hash is another one, the
/// same for the same numbers. @throws ConfigError also where the file has no such number, or where it is the
/// overlay's that would hide it.
RobotConfig load_robot(const std::string& robot, const std::map<std::string, double>& numbers);

/// The same of a robot.yaml that is read already: its folder is "", its hash 0.
RobotConfig read_robot(const YamlMap& file);

/// The same from the text of a robot.yaml, as a log holds one. Its folder is "". @param name stands for the
/// path in messages.
RobotConfig read_robot_text(const std::string& yaml, const std::string& name);

/// Folder of a robot by name or path: names are looked for in $SPRUNG_ROBOTS, else in robots/ of the source
/// tree, else in /usr/local/share/sprung/robots and /usr/share/sprung/robots.
/// @throws ConfigError naming the folders looked in and the robots found there.
std::string robot_folder(const std::string& robot);
/// Where robots of a name are: of the variable SPRUNG_ROBOTS, else the source tree's, else the package's.
std::string robots_folder();

}  // namespace sprung
