#include "tools/lab/identify/identified_robot.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "robots/config_error.h"
#include "robots/identification_sections.h"
#include "robots/yaml_expansion.h"
#include "robots/yaml_text.h"
#include "robots/yaml_tree.h"
#include "signals/number_text.h"
#include "tools/lab/identify/drive_series.h"
#include "tools/lab/identify/fragment.h"

namespace sprung::identify {
namespace {

namespace fs = std::filesystem;

/// Digits that bring a double back.
constexpr int kAllDigits = 17;

YamlTree& entry(YamlTree& file, const std::string& list, const std::string& name, const std::string& path) {
  if (YamlTree* found = file.find(list)) {
    for (YamlTree& item : found->items) {
      if (item.name() == name) return item;
    }
  }
  throw ConfigError(path + ": " + list + " has no '" + name + "'");
}

void replace(YamlTree& map, const std::string& key, YamlTree value) {
  if (YamlTree* found = map.find(key)) {
    *found = std::move(value);
    return;
  }
  map.keys.push_back({key, 0});
  map.items.push_back(std::move(value));
}

YamlTree quantity_tree(double value, const std::string& unit) {
  YamlTree out;
  out.text = number_text(value, kAllDigits) + " " + unit;
  return out;
}

void put_joint(YamlTree& file, const JointConfig& joint, const std::string& path) {
  YamlTree& map = entry(file, "joints", joint.name, path);
  const YamlTree found = parse_yaml("joint:\n" + identification_text(joint), path);
  const YamlTree& keys = found.items.front();
  for (std::size_t i = 0; i < keys.keys.size(); ++i) replace(map, keys.keys[i].name, keys.items[i]);
  replace(map, "armature", quantity_tree(joint.armature_kg_m2, "kg m^2"));
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

RobotChange change_of(const RobotConfig& robot, const IdentifiedJoint& joint, const Provenance& provenance,
                      const OtherDays& days) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].name != joint.name) continue;
    RobotChange out;
    out.joint = identified_config(joint, robot.joints[j], provenance, days);
    out.joint.friction->record.robot = robot.name;
    if (const auto constant = corrected_torque_constant(joint)) {
      const LegPlace at = place_of(robot, static_cast<int>(j));
      const ActuatorConfig& actuator = robot.actuators[robot.legs[at.leg].actuators[at.place]];
      out.actuator = actuator.name;
      out.torque_constant_Nm_A = constant->factor * actuator.torque_constant_Nm_A;
      out.torque_limit_Nm = std::min(1.0, constant->factor) * actuator.torque_limit_Nm;
    }
    return out;
  }
  throw std::invalid_argument(robot.name + " has no joint '" + joint.name + "'");
}

std::string with_identified(const std::string& yaml, const std::string& name,
                            const std::vector<RobotChange>& changes) {
  YamlTree file = parse_yaml(yaml, name);
  expand(file, name);
  for (const RobotChange& change : changes) {
    put_joint(file, change.joint, name);
    if (change.actuator.empty()) continue;
    YamlTree& actuator = entry(file, "actuators", change.actuator, name);
    replace(actuator, "torque_constant", quantity_tree(change.torque_constant_Nm_A, "Nm/A"));
    replace(actuator, "torque_limit", quantity_tree(change.torque_limit_Nm, "Nm"));
  }
  return "# Written by sprung identify from " + name + ", typed out.\n" + yaml_text(file);
}

void write_identified_robot(const RobotConfig& robot, const std::vector<RobotChange>& changes,
                            const std::string& folder) {
  const fs::path target(folder);
  if (fs::exists(target / "robot.yaml"))
    throw std::runtime_error(folder + " holds a robot.yaml already: name another folder, or remove it");
  fs::create_directories(target);
  for (const fs::directory_entry& file : fs::directory_iterator(robot.folder)) {
    if (file.is_regular_file() && file.path().filename() != "robot.yaml")
      fs::copy_file(file.path(), target / file.path().filename(), fs::copy_options::overwrite_existing);
  }
  const std::string from = robot.folder + "/robot.yaml";
  std::ofstream out(target / "robot.yaml", std::ios::binary);
  out << with_identified(text_of(from), from, changes);
  out.close();
  if (!out) throw std::runtime_error((target / "robot.yaml").string() + ": cannot be written");
}

}  // namespace sprung::identify
