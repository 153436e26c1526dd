#pragma once
/// The scene of a log's robot: by the model.xml that is installed here. Shell: reads files.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "robots/robot_config.h"
#include "sprung_msgs/log_metadata_t.hpp"

namespace sprung::station {

struct LoggedScene {
  std::shared_ptr<const nlohmann::json> scene;  ///< scene.h's; nullptr: there is none
  std::string model_xml;                        ///< its text
  std::string missing;                          ///< why there is none
  std::string note;                             ///< what is to be said about it; "" = nothing
};

/// @param robot of the log; its folder is "" where it came from the log's own robot.yaml: then model.xml is
/// looked for in the robots folder by the robot's name, and the lengths in that folder's robot.yaml are
/// compared.
LoggedScene scene_of_log(RobotConfig robot, const std::optional<sprung_msgs::log_metadata_t>& metadata);

}  // namespace sprung::station
