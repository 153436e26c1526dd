#pragma once
/// Grounds and payloads that an endurance run is drawn on besides its plant. Pure.
#include <cstdint>
#include <map>
#include <string>

#include "robots/robot_config.h"

namespace sprung {

/// Keys of `--plant`: a slope in any direction, everywhere (one that begins somewhere is there as much
/// steeper as it is far to the side), or hills and hollows, of what every gait of pegasus passes in `sprung
/// experiment terrain` at most; a payload on every other. The same number gives the same.
std::map<std::string, double> endurance_world(const RobotConfig& robot, std::uint64_t number);

}  // namespace sprung
