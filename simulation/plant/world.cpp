#include "simulation/plant/world.h"

#include <cstring>
#include <filesystem>
#include <set>

#include "robots/robot_loader.h"

namespace sprung::sim {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest_m = 1000.0;

GroundArea read_area(const YamlMap& map) {
  GroundArea area;
  area.from_m = map.quantity("from", "m", -kFarthest_m, kFarthest_m);
  area.length_m = map.quantity_or("length", "m", 0, kFarthest_m, 0.0);
  area.right_m = map.quantity_or("right", "m", -kFarthest_m, kFarthest_m, 0.0);
  area.width_m = map.quantity_or("width", "m", 0, kFarthest_m, 0.0);
  return area;
}

GroundStep read_step(const YamlMap& map) {
  const GroundStep step{read_area(map), map.quantity("height", "m", -1, 1)};
  map.finish();
  return step;
}

/// A flight is as many steps, each on top of the one before.
void read_stairs(const YamlMap& map, std::vector<GroundStep>& steps) {
  const auto count = static_cast<int>(map.integer("steps", 1, 1000));
  const double from_m = map.quantity("from", "m", -kFarthest_m, kFarthest_m);
  const double tread_m = map.quantity("tread", "m", 0.05, 10);
  const double rise_m = map.quantity("rise", "m", -1, 1);
  map.finish();
  for (int i = 0; i < count; ++i) steps.push_back({{from_m + i * tread_m}, rise_m});
}

GroundRamp read_ramp(const YamlMap& map) {
  GroundRamp ramp;
  ramp.from_m = map.quantity("from", "m", -kFarthest_m, kFarthest_m);
  ramp.length_m = map.quantity("length", "m", 0.01, kFarthest_m);
  ramp.slope_rad = map.quantity("slope", "rad", -1, 1);
  map.finish();
  return ramp;
}

GroundPatch read_patch(const YamlMap& map) {
  const GroundPatch patch{read_area(map), map.quantity("friction", "", 0, 10)};
  map.finish();
  return patch;
}

void read_rough(const YamlMap& map, GroundConfig& ground) {
  ground.rough_m = map.quantity("height", "m", 0, 1);
  ground.rough_grid_m = map.quantity_or("grid", "m", 0.05, 100, ground.rough_grid_m);
  map.finish();
}

fs::path worlds_beside(const RobotConfig& robot) {
  return fs::absolute(robot.folder).lexically_normal().parent_path() / "worlds";
}

std::string worlds_found(const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

GroundConfig read_ground(const YamlMap& map) {
  GroundConfig ground;
  ground.slope_rad = map.quantity_or("slope", "rad", -1, 1, 0.0);
  ground.side_slope_rad = map.quantity_or("side_slope", "rad", -1, 1, 0.0);
  ground.begins_m = map.quantity_or("begins", "m", -kFarthest_m, kFarthest_m, kNaN);
  ground.wave_m = map.quantity_or("wave", "m", 0, 1, 0.0);
  ground.wave_length_m = map.quantity_or("wave_length", "m", 0.05, kFarthest_m, ground.wave_length_m);
  ground.error_m = map.quantity_or("error", "m", 0, 1, 0.0);
  if (map.has("rough")) read_rough(map.map("rough"), ground);
  const auto each = [&map](const char* key, auto read) {
    if (!map.has(key)) return;
    for (const YamlMap& one : map.list(key)) read(one);
  };
  each("steps", [&](const YamlMap& one) { ground.steps.push_back(read_step(one)); });
  each("stairs", [&](const YamlMap& one) { read_stairs(one, ground.steps); });
  each("ramps", [&](const YamlMap& one) { ground.ramps.push_back(read_ramp(one)); });
  each("patches", [&](const YamlMap& one) { ground.patches.push_back(read_patch(one)); });
  map.finish();
  return ground;
}

World read_world(const YamlMap& file) {
  World world;
  world.what = file.text("world");
  world.ground = read_ground(file.map("ground"));
  if (file.has("friction")) world.friction = file.quantity("friction", "", 0, 10);
  file.finish();
  return world;
}

std::string world_path(const RobotConfig& robot, const std::string& world) {
  std::error_code unreadable;
  if (fs::path(world).extension() == ".yaml") {
    if (!fs::exists(world, unreadable)) throw ConfigError("no world: there is no file " + world);
    return world;
  }
  std::vector<fs::path> folders{worlds_beside(robot)};
  const fs::path usual = fs::path(robots_folder()).lexically_normal() / "worlds";
  if (usual != folders.front()) folders.push_back(usual);
  std::string looked_in;
  for (const fs::path& folder : folders) {
    const fs::path path = folder / (world + ".yaml");
    if (!world.empty() && fs::exists(path, unreadable)) return path.string();
    looked_in += (looked_in.empty() ? "" : " or ") + folder.string();
  }
  throw ConfigError("no world '" + world + "': no " + world + ".yaml in " + looked_in +
                    "; worlds there: " + worlds_found(folders));
}

void take_world(const RobotConfig& robot, std::map<std::string, double>& changes, PlantConfig& plant) {
  const std::size_t prefix = std::strlen(kWorldKey);
  const auto names_one = [&](auto at) { return at != changes.end() && at->first.rfind(kWorldKey, 0) == 0; };
  auto at = changes.lower_bound(kWorldKey);
  if (!names_one(at)) return;
  const std::string name = at->first.substr(prefix);
  at = changes.erase(at);
  if (names_one(at))
    throw ConfigError("worlds " + name + " and " + at->first.substr(prefix) + ": a robot is in one");
  const World world = read_world(YamlMap::load(world_path(robot, name)));
  plant.ground = world.ground;
  if (world.friction) plant.contact.friction = *world.friction;
}

}  // namespace sprung::sim
