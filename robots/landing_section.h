#pragma once
/// A preset's optional key `own_landing`.
#include "robots/own_landing_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// @throws ConfigError naming file, line, key and what was expected.
OwnLandingConfig read_own_landing(const YamlMap& map);

}  // namespace sprung::robot_sections
