#include "robots/robot_loader.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "robots/file_version.h"
#include "robots/gait_section.h"
#include "robots/identification_sections.h"
#include "robots/overlay.h"
#include "robots/preset_section.h"
#include "robots/reading_sections.h"
#include "robots/robot_numbers.h"
#include "robots/robot_sections.h"
#include "robots/text_hash.h"

namespace sprung {

namespace fs = std::filesystem;
using namespace robot_sections;

namespace {

struct NodeName {
  std::string name;
  int bus = 0;
  int node = 0;
};

/// Two nodes on one id would answer each other's commands.
void refuse_shared_node_ids(const YamlMap& file, const RobotConfig& robot) {
  std::vector<NodeName> nodes;
  for (const ActuatorConfig& actuator : robot.actuators)
    nodes.push_back({actuator.name, actuator.bus, actuator.node});
  for (const EncoderCardConfig& card : robot.encoder_cards) nodes.push_back({card.name, card.bus, card.node});
  if (robot.battery.bus >= 0) nodes.push_back({"battery", robot.battery.bus, robot.battery.node});
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (nodes[i].bus == nodes[j].bus && nodes[i].node == nodes[j].node) {
        const std::size_t cards_end = robot.actuators.size() + robot.encoder_cards.size();
        file.fail(i < robot.actuators.size() ? "actuators"
                  : i < cards_end            ? "encoder_cards"
                                             : "battery",
                  nodes[j].name + " and " + nodes[i].name + " share node id " +
                      std::to_string(nodes[i].node) + " on bus " + robot.buses[nodes[i].bus].name);
      }
    }
  }
}

void refuse_shared_channels(const YamlMap& file, const RobotConfig& robot) {
  for (const ActuatorConfig& a : robot.actuators) {
    for (const ActuatorConfig& b : robot.actuators) {
      const bool same = a.link_encoder.card == b.link_encoder.card &&
                        a.link_encoder.channel == b.link_encoder.channel;
      if (&a < &b && a.link_encoder.card >= 0 && same) {
        file.fail("actuators", a.name + " and " + b.name + " share channel " +
                                   std::to_string(a.link_encoder.channel) + " of encoder card " +
                                   robot.encoder_cards[a.link_encoder.card].name);
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
      file.fail("legs", "joint " + robot.joints[i].name +
                            " must belong to exactly one leg (kinematics: none for joints alone)");
    }
  }
  for (int i = 0; i < static_cast<int>(robot.actuators.size()); ++i) {
    if (actuators.count(i) != 1) {
      file.fail("legs", "actuator " + robot.actuators[i].name + " must belong to exactly one leg");
    }
  }
}

void refuse_contradictions(const YamlMap& file, const RobotConfig& robot) {
  refuse_shared_node_ids(file, robot);
  refuse_shared_channels(file, robot);
  refuse_loose_joints(file, robot);
  refuse_folded_link_positions(file, robot);
  if (robot.presets.empty() && robot.has_feet()) {
    file.fail("presets", "at least one preset is needed");
  }
}

/// Buses, and the nodes on them.
void read_nodes(const YamlMap& file, RobotConfig& robot) {
  for (const YamlMap& map : file.list("buses")) {
    robot.buses.push_back(read_bus(map));
  }
  refuse_same_names(file, "buses", robot.buses);
  robot.bit_rate_bit_s = read_bit_rate(file);
  if (file.has("encoder_cards")) {
    for (const YamlMap& map : file.list("encoder_cards")) {
      robot.encoder_cards.push_back(read_encoder_card(map, robot.buses));
    }
    refuse_same_names(file, "encoder_cards", robot.encoder_cards);
  }
  for (const YamlMap& map : file.list("actuators")) {
    robot.actuators.push_back(read_actuator(map, robot));
  }
  if (file.has("battery")) robot.battery = read_battery(file.map("battery"), robot.buses);
  refuse_same_names(file, "actuators", robot.actuators);
}

void read_presets(const YamlMap& file, RobotConfig& robot) {
  if (!robot.has_feet() && !file.has("presets")) return;
  const YamlMap presets = file.map("presets");
  for (const auto& [name, map] : presets.entries()) {
    robot.presets.push_back(read_preset(name, map));
  }
}

/// Where an upgrade has kept a changed file, dpkg puts the package's own beside it: that one shows what is
/// called otherwise now.
RobotConfig read_kept_robot(const std::string& path, const std::map<std::string, double>& numbers) {
  try {
    YamlMap file = YamlMap::load(path);
    for (const auto& [way, value] : numbers) file = file.with_number_at(way, value);
    return read_robot(file);
  } catch (const ConfigError& error) {
    const std::string shipped = path + ".dpkg-dist";
    std::error_code none;
    if (!fs::exists(shipped, none)) throw;
    throw ConfigError(std::string(error.what()) + "; an upgrade has kept your file, see what is new: diff " +
                      path + " " + shipped);
  }
}

/// "" without any, so that they change no hash.
std::string numbers_text(const std::map<std::string, double>& numbers) {
  std::string text;
  for (const auto& [way, value] : numbers) text += way + "=" + exact_text(value) + "\n";
  return text;
}

constexpr const char* kUsualPreset = "best";

/// What a planner and controller can be made of where there is nothing to preset: any curve, never played.
PresetConfig still_preset() {
  PresetConfig still;
  still.name = "none";
  still.compensated_friction = CompensatedFriction::kIdentified;
  still.stand_length_m = still.sit_length_m = still.landing_length_m = 1.0;
  still.jump_curve = {1.0, {1.0, 1.0}, 1.0};
  return still;
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

/// The source tree's; on a machine without it, as where a package of sprung is installed, that one's.
fs::path usual_robots() {
  std::error_code none;
  for (const char* folder : {SPRUNG_ROBOTS_DIR, "/usr/local/share/sprung/robots"}) {
    if (fs::is_directory(folder, none)) return folder;
  }
  return "/usr/share/sprung/robots";
}

}  // namespace

std::string robots_folder() {
  const char* variable = std::getenv("SPRUNG_ROBOTS");
  return variable != nullptr && *variable != '\0' ? variable : usual_robots().string();
}

std::string robot_folder(const std::string& robot) {
  const fs::path robots = robots_folder();
  std::error_code unreadable;  // the current folder may be somebody else's: sudo -u, services
  for (const fs::path& folder : {fs::path(robot), robots / robot}) {
    if (!robot.empty() && fs::exists(folder / "robot.yaml", unreadable)) {
      return folder.string();
    }
  }
  throw ConfigError("no robot '" + robot + "': no robot.yaml in ./" + robot + " or " +
                    (robots / robot).string() + "; robots there: " + robots_found(robots));
}

RobotConfig read_robot(const YamlMap& file) {
  check_file_version(file);
  RobotConfig robot;
  robot.name = file.text("robot");
  robot.cycle_s = 1.0 / file.quantity("cycle_rate", "Hz", 10, 4000);
  read_nodes(file, robot);
  for (const YamlMap& map : file.list("joints")) {
    robot.joints.push_back(read_joint(map));
  }
  refuse_same_names(file, "joints", robot.joints);
  for (const YamlMap& map : file.list("legs")) {
    robot.legs.push_back(read_leg(map, robot));
  }
  refuse_same_names(file, "legs", robot.legs);
  if (file.has("estimation")) robot.estimation = read_estimation(file.map("estimation"));
  robot.watchdogs = read_watchdogs(file.map("watchdogs"), false);
  robot.simulation_watchdogs = read_watchdogs(file.map("simulation_watchdogs"), true);
  if (file.has("body")) robot.body = read_body(file.map("body"));
  if (file.has("gaits")) robot.gaits = read_gaits(file.map("gaits"), robot.legs.size());
  read_presets(file, robot);
  for (const YamlMap& map : file.list("processes")) {
    robot.processes.push_back(read_process(map));
  }
  const bool overlaid = file.has("overlay");  // a log's robot; files have it beside them
  file.finish();
  refuse_contradictions(file, robot);
  if (overlaid) apply_overlay(file.map("overlay"), robot);
  return robot;
}

RobotConfig load_robot(const std::string& robot) { return load_robot(robot, {}); }

RobotConfig load_robot(const std::string& robot, const std::map<std::string, double>& numbers) {
  const std::string folder = robot_folder(robot);
  const std::string path = (fs::path(folder) / "robot.yaml").string();
  RobotConfig config = read_kept_robot(path, numbers);
  config.folder = folder;
  config.hash = hash_text(without_overlay(text_of_file(path)) + numbers_text(numbers));
  const fs::path overlay = overlay_path(folder);
  if (fs::exists(overlay)) apply_overlay(YamlMap::load(overlay.string()), config);
  for (const OverlaidNumber& one : config.overlay) {
    if (numbers.count(one.path) > 0)
      throw ConfigError(overlaid_text(one) + ", and another value of it is asked for: take it out of " +
                        overlay.string());
  }
  return config;
}

RobotConfig read_robot_text(const std::string& yaml, const std::string& name) {
  RobotConfig config = read_robot(YamlMap::parse(yaml, name));
  config.hash = hash_text(without_overlay(yaml));
  return config;
}

std::set<std::string> robot_numbers(const std::string& robot) {
  const YamlMap file = YamlMap::load((fs::path(robot_folder(robot)) / "robot.yaml").string());
  (void)read_robot(file);
  return file.questions().numbers;
}

const char* RobotConfig::why_not_standing() const {
  for (const LegConfig& leg : legs) {
    if (leg.kinematics == kNoKinematics) return "this robot's legs have no kinematics: it cannot stand";
    if (leg.kinematics == kOneLink) return "this robot has an arm where legs would be: it cannot stand";
  }
  return nullptr;
}

bool RobotConfig::has_auxiliary_readings() const noexcept {
  const auto reads = [](const ActuatorConfig& actuator) { return actuator.temperature.reading.index != 0; };
  return battery.bus >= 0 || std::any_of(actuators.begin(), actuators.end(), reads);
}

int RobotConfig::joint_of_actuator(int actuator) const noexcept {
  for (const LegConfig& leg : legs) {
    for (std::size_t i = 0; i < leg.actuators.size(); ++i)
      if (leg.actuators[i] == actuator) return leg.joints[i];
  }
  return -1;
}

const PresetConfig& RobotConfig::preset(const std::string& preset_name) const {
  static const PresetConfig still = still_preset();
  if (presets.empty() && !has_feet()) return still;
  if (preset_name.empty() && presets.size() == 1) return presets.front();
  const std::string wanted = preset_name.empty() ? kUsualPreset : preset_name;
  std::string known;
  for (const PresetConfig& candidate : presets) {
    if (candidate.name == wanted) return candidate;
    known += (known.empty() ? "" : ", ") + candidate.name;
  }
  throw std::invalid_argument(
      preset_name.empty() ? "robot " + name + " has several presets and none is called " + kUsualPreset +
                                ": choose with --preset, one of: " + known
                          : "no preset '" + preset_name + "' in robot " + name + "; there are: " + known);
}

std::string preset_or(const RobotConfig& robot, const std::string& wished, const std::string& otherwise) {
  const bool there = std::any_of(robot.presets.begin(), robot.presets.end(),
                                 [&](const PresetConfig& preset) { return preset.name == wished; });
  return robot.preset(there ? wished : otherwise).name;
}

RobotConfig as_in_preset(RobotConfig robot, const std::string& preset_name) {
  if (robot.preset(preset_name).compensated_friction == CompensatedFriction::kIdentified) return robot;
  for (JointConfig& joint : robot.joints) {
    if (joint.friction) joint.uncertainty.friction = kPapersFrictionUncertainty;
    joint.friction.reset();
  }
  return robot;
}

}  // namespace sprung
