#pragma once
/// A preset of robot.yaml: control parameters that belong together.
#include <string>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// @throws ConfigError naming file, line, key and what was expected.
PresetConfig read_preset(const std::string& name, const YamlMap& map);

}  // namespace sprung::robot_sections
