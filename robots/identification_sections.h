#pragma once
/// The parts of a joint in robot.yaml that `sprung identify` writes: read for robot_sections.cpp, and written
/// as the same text.
#include <string>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung {

namespace robot_sections {

/// Keys `friction` with `identified`, `uncertainty` and `thermal` of a joint; each may be missing.
void read_identification(const YamlMap& joint_map, JointConfig& joint);
/// YYYY-MM-DD.
std::string read_date(const YamlMap& map, const std::string& key);
/// The key `estimation` of the robot.
EstimationConfig read_estimation(const YamlMap& map);

}  // namespace robot_sections

/// The keys `friction`, `uncertainty`, `identified` and, where there is a time constant, `thermal` of a joint
/// as lines of robot.yaml, each indented by four blanks; what load_robot() reads back.
/// @param joint its friction must be there: @throws std::invalid_argument if not.
std::string identification_text(const JointConfig& joint);

}  // namespace sprung
