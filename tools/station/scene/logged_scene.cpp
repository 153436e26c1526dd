#include "tools/station/scene/logged_scene.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "robots/overlay.h"
#include "robots/robot_loader.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {

namespace {

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

LoggedScene scene_of_log(RobotConfig robot, const std::optional<sprung_msgs::log_metadata_t>& metadata) {
  LoggedScene found;
  try {
    if (robot.folder.empty()) {
      robot.folder = robot_folder(robot.name);
      if (metadata && robot_text(robot.folder) != metadata->robot_yaml) {
        found.note = "The shapes are those of " + robot.folder +
                     "/model.xml, whose robot.yaml is another than this log's: lengths may differ.";
      }
    }
    found.scene = std::make_shared<nlohmann::json>(make_scene(robot, metadata ? metadata->preset : ""));
    found.model_xml = file_text(robot.folder + "/model.xml");
  } catch (const std::exception& error) {
    found.missing = std::string("No model of this robot is here: ") + error.what();
  }
  return found;
}

}  // namespace sprung::station
