#pragma once
/// robots/worlds/<name>.yaml: a ground that a simulated robot of any make is put on, and sim.yaml's `ground`,
/// which is written alike. Start-up only.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"
#include "simulation/plant/sim_config.h"

namespace sprung::sim {

/// Key of a change of the plant that names a world: this and the name, or the path of a file, with any value.
inline constexpr const char* kWorldKey = "world.";

struct World {
  std::string what;  ///< for people
  GroundConfig ground;
  std::optional<double> friction;  ///< of all of it, instead of sim.yaml's
};

GroundConfig read_ground(const YamlMap& map);
/// @throws ConfigError with file, line and value.
World read_world(const YamlMap& file);

/// Of a name: in `worlds` beside the robot's folder, or where robots usually are; or of a path that ends in
/// .yaml. @throws ConfigError with those that there are.
std::string world_path(const RobotConfig& robot, const std::string& world);

/// Takes worlds out of `changes` and puts the plant on the one that they name.
/// @throws ConfigError for two, and as above.
void take_world(const RobotConfig& robot, std::map<std::string, double>& changes, PlantConfig& plant);

}  // namespace sprung::sim
