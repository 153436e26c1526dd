#pragma once
/// The key `torsion` of a joint in robot.yaml:
///   torsion: {stiffness: 25000 Nm/rad, second_stiffness: 34000 Nm/rad, second_from: 14 Nm,
///             angle_std: 0.00002 rad, kinematic_error: [{order: 2, cosine: 0.00001 rad, sine: 0.00029 rad}]}
/// Both second_* and kinematic_error may be missing.
#include "robots/torsion_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// @throws ConfigError
GearTorsion read_torsion(const YamlMap& map);

}  // namespace sprung::robot_sections
