#pragma once
/// The sections of robot.yaml, one reader each; used by robot_loader.cpp alone.
#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

BusConfig read_bus(const YamlMap& map);
ActuatorConfig read_actuator(const YamlMap& map, const std::vector<BusConfig>& buses);
JointConfig read_joint(const YamlMap& map);
LegConfig read_leg(const YamlMap& map, const RobotConfig& robot);
WatchdogConfig read_watchdogs(const YamlMap& map);
PresetConfig read_preset(const std::string& name, const YamlMap& map);
ProcessConfig read_process(const YamlMap& map);

}  // namespace sprung::robot_sections
