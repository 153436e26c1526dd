/// A shipped robot.yaml with any edits; what the loader lets through must be good enough for the cores.
#include <stdexcept>

#include "controller/controller_core.h"
#include "drivers/bridge/bridge_core.h"
#include "estimator/estimator_core.h"
#include "planner/planner_core.h"
#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "robots/yaml_text.h"
#include "tests/fuzz/edited_text.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::robots_robot {
namespace {

const std::vector<std::string>& robots() {
  static const std::vector<std::string> all = {
      text_of("robots/single_leg/robot.yaml"), text_of("robots/test_axis/robot.yaml"),
      text_of("robots/pegasus/robot.yaml"), text_of("robots/fennec/robot.yaml")};
  return all;
}

std::vector<std::string> robot_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < robots().size(); ++i) {
    for (std::string& seed : edit_seeds(std::string(1, static_cast<char>(i)), lines_of(robots()[i]).size()))
      seeds.push_back(std::move(seed));
  }
  return seeds;
}

/// @param planner too: it looks for its highest jump, which takes most of the time.
void build_cores(const RobotConfig& robot, bool planner) {
  const BridgeCore bridge(robot, BridgeOptions{robot.watchdogs});
  const EstimatorCore estimator(robot);
  for (const PresetConfig& preset : robot.presets) {
    const ControllerCore controller(robot, preset, robot.watchdogs);
    if (planner) const PlannerCore planner_of_preset(robot, preset);
  }
}

}  // namespace

SPRUNG_FUZZ(robots_robot, robot_seeds) {
  const std::uint8_t head = input.byte();
  const std::string& shipped = robots()[head % robots().size()];
  try {
    const YamlMap file = YamlMap::parse(edited(shipped, input), "robot.yaml");
    build_cores(read_robot(file), head >= 240);
    parse_yaml(explained_yaml_text(file), "explained.yaml");
  } catch (const ConfigError&) {            // that is how mistakes are told,
  } catch (const std::invalid_argument&) {  // also by cores, of unknown profiles
  }
}

}  // namespace sprung::fuzz::robots_robot
