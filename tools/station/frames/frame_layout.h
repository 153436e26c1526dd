#pragma once
/// What a page must know to read frames, as JSON: the same for a log and for a live robot. Pure.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "robots/robot_config.h"
#include "tools/station/frames/frame_fields.h"

namespace sprung::station {

/// ```
/// {"robot": "single_leg", "cycle_s": 0.001, "joints": ["hip", "knee"], "legs": ["leg"],
///  "actuators": ["hip_motor", "knee_motor"],
///  "fields": [{"name": "joints.hip.estimated_position_rad", "unit": "rad"},
///             {"name": "safety.level", "unit": "", "words": {"0": "operational", ...}}, ...]}
/// ```
/// `fields` in the order of Frame::values.
nlohmann::json frame_layout(const RobotConfig& robot, const std::vector<FrameField>& fields);

}  // namespace sprung::station
