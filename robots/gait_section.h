#pragma once
/// robot.yaml's `body` and `gaits`, and a preset's `walk`: the keys of a robot that walks.
#include "robots/gait_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// @throws ConfigError naming file, line, key and what was expected.
StiffnessConfig read_stiffness(const YamlMap& map);
BodyConfig read_body(const YamlMap& map);
/// Gaits that could not be walked are refused: offsets that are not one for each leg, all feet in the air at
/// once, `to` a gait that there is not.
std::vector<GaitConfig> read_gaits(const YamlMap& map, std::size_t legs);
WalkConfig read_walk(const YamlMap& map);

}  // namespace sprung::robot_sections
