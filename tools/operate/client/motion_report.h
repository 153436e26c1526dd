#pragma once
/// What a robot does, told: MOTION_STATE, its body and feet from JOINT_STATE, where it is from BODY_STATE.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/message_layout.h"

namespace sprung {

/// A message that is as old tells what was: MOTION_STATE and JOINT_STATE come every cycle, SAFETY_STATE ten
/// times a second.
inline constexpr double kStale_s = 0.5;
/// "; STALE: nothing heard of the leg controller for 0.9 s"; empty where it is fresh.
std::string stale_text(const nlohmann::ordered_json& told, const char* who);

/// Keys state, last_transition, legs; on robots with gaits also gait (null: it does not walk), gait_phase,
/// desired_speed, ground (null: it does not walk) and payload (null: it has not stood up). Leg events are
/// counted since the planner began. State is "unknown" where nothing was heard.
/// @param age_s since it was heard: keys age_s, stale.
nlohmann::ordered_json motion_json(const RobotConfig& robot,
                                   const std::optional<sprung_msgs::motion_state_t>& motion,
                                   double age_s = 0.0);

/// Estimated attitude, height, speed and place (null: not known); numbers that are not known are null, all of
/// it where there is no body.
nlohmann::ordered_json body_json(const RobotConfig& robot,
                                 const std::optional<sprung_msgs::joint_state_t>& joints, double age_s = 0.0,
                                 const std::optional<sprung_msgs::body_state_t>& odometry = std::nullopt);

/// Both in lines for a terminal.
std::vector<std::string> motion_lines(const nlohmann::ordered_json& motion,
                                      const nlohmann::ordered_json& body);

}  // namespace sprung
