#pragma once
/// The scene of a robot that is up. Start-up only: reads files.
#include <nlohmann/json_fwd.hpp>

#include "robots/robot_config.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::station {

/// scene.h's, on the ground of its simulation; {"missing": why} where it cannot be drawn: then its panels
/// show it.
nlohmann::json scene_of_run(const RobotConfig& robot, const RunInfo& info);

}  // namespace sprung::station
