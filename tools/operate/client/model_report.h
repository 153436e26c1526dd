#pragma once
/// Whether the joints' models fit what is seen, told: JOINT_STATE and the dates of robot.yaml.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/message_layout.h"

namespace sprung {

/// A row for each joint: name, identified, fits, ratio, likely_reason, repeat (the recording that would tell
/// better, null where it fits). Empty where nothing was heard.
nlohmann::ordered_json models_json(const RobotConfig& robot,
                                   const std::optional<sprung_msgs::joint_state_t>& joints);
/// A line for each joint whose model does not fit.
std::vector<std::string> model_lines(const nlohmann::ordered_json& models);

/// Lines for joints whose identification is older than its robot.yaml allows, or of another robot.
/// @param today YYYY-MM-DD.
std::vector<std::string> doubtful_identifications(const RobotConfig& robot, const std::string& today);
/// The same for actuators whose zero stands in robot.yaml with a date.
std::vector<std::string> doubtful_zeros(const RobotConfig& robot, const std::string& today);

}  // namespace sprung
