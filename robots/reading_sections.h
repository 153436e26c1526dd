#pragma once
/// Sections of robot.yaml about what is read beside the cycle: `temperature` of an actuator, `battery`.
#include <vector>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// {object: 0x22A2, sub: 0, type: i16, scale: 0.1 degC, max: 85 degC}. @throws ConfigError.
TemperatureConfig read_temperature(const YamlMap& map);

/// {bus: power, node: 20, min_charge: 0.15}: the objects are those of CiA 418 where the file names no others.
/// @throws ConfigError.
BatteryConfig read_battery(const YamlMap& map, const std::vector<BusConfig>& buses);

}  // namespace sprung::robot_sections
