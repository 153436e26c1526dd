#pragma once
/// The ground of a simulated run, to be drawn under its robot. Start-up only.
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "robots/robot_config.h"

namespace sprung::station {

/// ```
/// {"from_m": [x, y], "spacing_m": 0.05, "columns": along x, "lines": along y,
///  "heights_mm": [of the first line, of the next, ...],
///  "patches": [{"from_m", "length_m", "right_m", "width_m", "friction"}], lengths and widths 0: without end}
/// ```
/// Without the stones that feet find. null where it is level and of one friction everywhere, as on a robot.
/// @param asked of the plant. A world that is not here any more is level.
nlohmann::json ground_scene(const RobotConfig& robot, const std::map<std::string, double>& asked);

}  // namespace sprung::station
