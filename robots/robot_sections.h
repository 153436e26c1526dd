#pragma once
/// The sections of robot.yaml, one reader each; used by robot_loader.cpp alone. What has to do with encoders,
/// homing and torsion is in encoder_sections.cpp.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "robots/torsion_config.h"
#include "robots/yaml_reader.h"

namespace sprung::robot_sections {

/// Position of `wanted` among named things. @throws ConfigError naming those there are.
template <class Named>
int index_of(const std::vector<Named>& things, const std::string& wanted, const YamlMap& map,
             const std::string& key) {
  std::string known;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name == wanted) {
      return static_cast<int>(i);
    }
    known += (known.empty() ? "" : ", ") + things[i].name;
  }
  map.fail(key, "'" + wanted + "' is not known; there are: " + (known.empty() ? "none" : known));
}

/// Index of `map`'s text under `key` in `known`. @throws ConfigError naming them.
int choice(const YamlMap& map, const std::string& key, const std::vector<std::string>& known);

BusConfig read_bus(const YamlMap& map);
/// Of the whole robot's buses: the standard ones up to 1 Mbit/s; 1 Mbit/s where the key is missing.
double read_bit_rate(const YamlMap& file);
IdentityConfig read_identity(const YamlMap& map);
/// The optional key `watch` of an actuator or an encoder card.
NodeWatch read_node_watch(const YamlMap& map);
EncoderCardConfig read_encoder_card(const YamlMap& map, const std::vector<BusConfig>& buses);
/// @param robot its buses and encoder cards are there already.
ActuatorConfig read_actuator(const YamlMap& map, const RobotConfig& robot);
LinkEncoderConfig read_link_encoder(const YamlMap& map, const std::vector<EncoderCardConfig>& cards);
ReferenceConfig read_reference(const YamlMap& map);
/// The key `torsion` of a joint:
///   torsion: {stiffness: 25000 Nm/rad, second_stiffness: 34000 Nm/rad, second_from: 14 Nm,
///             angle_std: 0.00002 rad, kinematic_error: [{order: 2, cosine: 0.00001 rad, sine: 0.00029 rad}]}
/// Both second_* and kinematic_error may be missing.
GearTorsion read_torsion(const YamlMap& map);
/// A link position is known within half a turn either way of zero: an actuator with a link encoder must stay
/// there wherever its leg's joints are within their limits.
void refuse_folded_link_positions(const YamlMap& file, const RobotConfig& robot);
/// +1 or -1. @throws ConfigError on 0 too.
double read_direction(const YamlMap& map);
JointConfig read_joint(const YamlMap& map);
LegConfig read_leg(const YamlMap& map, const RobotConfig& robot);
/// @param simulation simulation_watchdogs: may wait longer than any robot should.
WatchdogConfig read_watchdogs(const YamlMap& map, bool simulation);
ProcessConfig read_process(const YamlMap& map);

}  // namespace sprung::robot_sections
