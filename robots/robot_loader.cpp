#include "robots/robot_loader.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "robots/robot_sections.h"

namespace sprung {

namespace fs = std::filesystem;
using namespace robot_sections;

namespace {

/// FNV-1a: a name for a configuration, no protection against anyone.
std::int64_t hash_text(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return static_cast<std::int64_t>(hash >> 1);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Two drives on one node id would answer each other's commands.
void refuse_shared_node_ids(const YamlMap& file, const std::vector<ActuatorConfig>& actuators,
                            const std::vector<BusConfig>& buses) {
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (actuators[i].bus == actuators[j].bus && actuators[i].node == actuators[j].node) {
        file.fail("actuators", actuators[j].name + " and " + actuators[i].name + " share node id " +
                                   std::to_string(actuators[i].node) + " on bus " +
                                   buses[static_cast<std::size_t>(actuators[i].bus)].name);
      }
    }
  }
}

template <class Named>
void refuse_same_names(const YamlMap& file, const std::string& key, const std::vector<Named>& things) {
  std::set<std::string> names;
  for (const Named& thing : things) {
    if (!names.insert(thing.name).second) {
      file.fail(key, "the name '" + thing.name + "' stands twice");
    }
  }
}

/// Every joint and every actuator belongs to exactly one leg.
void refuse_loose_joints(const YamlMap& file, const RobotConfig& robot) {
  std::multiset<int> joints;
  std::multiset<int> actuators;
  for (const LegConfig& leg : robot.legs) {
    joints.insert(leg.joints.begin(), leg.joints.end());
    actuators.insert(leg.actuators.begin(), leg.actuators.end());
  }
  for (int i = 0; i < static_cast<int>(robot.joints.size()); ++i) {
    if (joints.count(i) != 1) {
      file.fail("legs", "joint " + robot.joints[static_cast<std::size_t>(i)].name +
                            " must belong to exactly one leg");
    }
  }
  for (int i = 0; i < static_cast<int>(robot.actuators.size()); ++i) {
    if (actuators.count(i) != 1) {
      file.fail("legs", "actuator " + robot.actuators[static_cast<std::size_t>(i)].name +
                            " must belong to exactly one leg");
    }
  }
}

void refuse_contradictions(const YamlMap& file, const RobotConfig& robot) {
  refuse_shared_node_ids(file, robot.actuators, robot.buses);
  refuse_loose_joints(file, robot);
  if (robot.presets.empty()) {
    file.fail("presets", "at least one preset is needed");
  }
}

RobotConfig read_robot(const YamlMap& file) {
  RobotConfig robot;
  robot.name = file.text("robot");
  robot.cycle_s = 1.0 / file.quantity("cycle_rate", "Hz", 10, 4000);
  for (const YamlMap& map : file.list("buses")) {
    robot.buses.push_back(read_bus(map));
  }
  refuse_same_names(file, "buses", robot.buses);
  for (const YamlMap& map : file.list("actuators")) {
    robot.actuators.push_back(read_actuator(map, robot.buses));
  }
  refuse_same_names(file, "actuators", robot.actuators);
  for (const YamlMap& map : file.list("joints")) {
    robot.joints.push_back(read_joint(map));
  }
  refuse_same_names(file, "joints", robot.joints);
  for (const YamlMap& map : file.list("legs")) {
    robot.legs.push_back(read_leg(map, robot));
  }
  refuse_same_names(file, "legs", robot.legs);
  robot.watchdogs = read_watchdogs(file.map("watchdogs"));
  robot.simulation_watchdogs = read_watchdogs(file.map("simulation_watchdogs"));
  const YamlMap presets = file.map("presets");
  for (const auto& [name, map] : presets.entries()) {
    robot.presets.push_back(read_preset(name, map));
  }
  for (const YamlMap& map : file.list("processes")) {
    robot.processes.push_back(read_process(map));
  }
  file.finish();
  refuse_contradictions(file, robot);
  return robot;
}

std::string robots_found(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (fs::exists(entry.path() / "robot.yaml", ignored)) {
      names.insert(entry.path().filename().string());
    }
  }
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::string robot_folder(const std::string& robot) {
  const char* variable = std::getenv("SPRUNG_ROBOTS");
  const fs::path robots = variable != nullptr ? variable : SPRUNG_ROBOTS_DIR;
  for (const fs::path& folder : {fs::path(robot), robots / robot}) {
    if (!robot.empty() && fs::exists(folder / "robot.yaml")) {
      return folder.string();
    }
  }
  throw ConfigError("no robot '" + robot + "': no robot.yaml in ./" + robot + " or " +
                    (robots / robot).string() + "; robots there: " + robots_found(robots));
}

RobotConfig load_robot(const std::string& robot) {
  const std::string folder = robot_folder(robot);
  const std::string path = (fs::path(folder) / "robot.yaml").string();
  RobotConfig config = read_robot(YamlMap::load(path));
  config.folder = folder;
  config.hash = hash_text(read_file(path));
  return config;
}

const PresetConfig& RobotConfig::preset(const std::string& preset_name) const {
  std::string known;
  for (const PresetConfig& candidate : presets) {
    if (candidate.name == preset_name) {
      return candidate;
    }
    known += (known.empty() ? "" : ", ") + candidate.name;
  }
  throw std::invalid_argument("no preset '" + preset_name + "' in robot " + name + "; there are: " + known);
}

}  // namespace sprung
