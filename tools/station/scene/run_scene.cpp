#include "tools/station/scene/run_scene.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "simulation/plant/plant_words.h"
#include "tools/station/scene/ground_scene.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {

nlohmann::json scene_of_run(const RobotConfig& robot, const RunInfo& info) {
  try {
    nlohmann::json scene = make_scene(robot, info.preset);
    scene["ground"] = info.simulation ? ground_scene(robot, parse_plant(info.plant)) : nullptr;
    return scene;
  } catch (const std::exception& error) {
    return {{"missing", error.what()}};
  }
}

}  // namespace sprung::station
