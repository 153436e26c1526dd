#pragma once
/// A preset of robot.yaml: control parameters that belong together.
#include <string>

#include "robots/adaptive_landing_config.h"
#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// A preset's optional key `adaptive_landing`.
/// @throws ConfigError naming file, line, key and what was expected.
AdaptiveLandingConfig read_adaptive_landing(const YamlMap& map);

/// @throws ConfigError naming file, line, key and what was expected.
PresetConfig read_preset(const std::string& name, const YamlMap& map);

}  // namespace sprung::robot_sections
