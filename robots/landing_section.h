#pragma once
/// A preset's optional key `adaptive_landing`.
#include "robots/adaptive_landing_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// @throws ConfigError naming file, line, key and what was expected.
AdaptiveLandingConfig read_adaptive_landing(const YamlMap& map);

}  // namespace sprung::robot_sections
