#include "tools/station/scene/run_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

RunInfo simulated(std::vector<std::string> plant) {
  RunInfo info;
  info.preset = "best";
  info.simulation = true;
  info.plant = std::move(plant);
  return info;
}

TEST(RunScene, HasTheGroundOfItsWorld) {
  const RobotConfig robot = load_robot("pegasus");
  const auto scene = scene_of_run(robot, simulated({"world=stairs"}));
  const auto& heights_mm = scene.at("ground").at("heights_mm");
  EXPECT_NE(*std::max_element(heights_mm.begin(), heights_mm.end()), 0);
  EXPECT_TRUE(scene_of_run(robot, simulated({})).at("ground").is_null()) << "level";
}

TEST(RunScene, NobodyKnowsTheGroundUnderARobot) {
  RunInfo info = simulated({"world=stairs"});
  info.simulation = false;
  EXPECT_TRUE(scene_of_run(load_robot("pegasus"), info).at("ground").is_null());
}

TEST(RunScene, ARobotThatCannotBeDrawnSaysWhy) {
  RobotConfig robot = load_robot("pegasus");
  robot.folder = "/nowhere";
  const auto scene = scene_of_run(robot, simulated({}));
  EXPECT_NE(scene.at("missing").get<std::string>().find("/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace sprung::station
