#include "tools/station/scene/logged_scene.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "simulation/plant/plant_words.h"
#include "tools/station/scene/ground_scene.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {

namespace {

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// As they are drawn. A robot.yaml may differ in much besides: an overlay's numbers, another bus.
bool same_lengths(const RobotConfig& a, const RobotConfig& b) {
  const auto same_link = [](const LinkConfig& x, const LinkConfig& y) { return x.length_m == y.length_m; };
  const auto same_leg = [&](const LegConfig& x, const LegConfig& y) {
    return x.hip_in_trunk_m == y.hip_in_trunk_m && x.foot_radius_m == y.foot_radius_m &&
           std::equal(x.links.begin(), x.links.end(), y.links.begin(), y.links.end(), same_link);
  };
  return std::equal(a.legs.begin(), a.legs.end(), b.legs.begin(), b.legs.end(), same_leg);
}

/// A file that cannot be read has none.
bool has_lengths_of(const std::string& folder, const RobotConfig& robot) {
  try {
    return same_lengths(robot, load_robot(folder));
  } catch (const ConfigError&) {
    return false;
  }
}

}  // namespace

LoggedScene scene_of_log(RobotConfig robot, const std::optional<sprung_msgs::log_metadata_t>& metadata) {
  LoggedScene found;
  try {
    if (robot.folder.empty()) {
      robot.folder = robot_folder(robot.name);
      if (metadata && !has_lengths_of(robot.folder, robot))
        found.note = "The shapes are those of " + robot.folder +
                     "/model.xml, whose robot.yaml has other lengths than this log's.";
    }
    nlohmann::json scene = make_scene(robot, metadata ? metadata->preset : "");
    scene["ground"] = metadata ? ground_scene(robot, plant_of_command(metadata->command_line)) : nullptr;
    found.scene = std::make_shared<nlohmann::json>(std::move(scene));
    found.model_xml = file_text(robot.folder + "/model.xml");
  } catch (const std::exception& error) {
    found.missing = std::string("No model of this robot is here: ") + error.what();
  }
  return found;
}

}  // namespace sprung::station
