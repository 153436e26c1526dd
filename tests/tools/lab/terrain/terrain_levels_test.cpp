#include "tools/lab/terrain/terrain_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "robots/yaml_reader.h"
#include "tests/support/own_folder.h"

namespace sprung {
namespace {

class TerrainLevelsTest : public testing::Test {
 protected:
  std::vector<TerrainTask> of(const std::string& text) {
    std::ofstream(scratch_ / "terrain.yaml") << text;
    RobotConfig robot = load_robot("pegasus");
    robot.folder = scratch_.path().string();
    return terrain_tasks_of(robot);
  }
  std::string refusal(const std::string& text) {
    try {
      of(text);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  }
  static const TerrainTask& task(const std::vector<TerrainTask>& tasks, const std::string& name) {
    return *std::find_if(tasks.begin(), tasks.end(), [&](const TerrainTask& t) { return t.name == name; });
  }

  test::OwnFolder scratch_{"terrain-levels"};
};

TEST_F(TerrainLevelsTest, AFileSaysLevelsAndWhatIsWantedAndTheOthersStay) {
  const std::vector<TerrainTask> tasks = of(
      "robot: pegasus\n"
      "tasks:\n"
      "  wave: {levels: [5 mm, 9 mm], wanted: {trot: 9 mm}}\n"
      "  friction: {levels: [0.5, 0.2]}\n");
  EXPECT_EQ(tasks.size(), terrain_tasks().size());
  EXPECT_EQ(task(tasks, "wave").levels, (std::vector<double>{5.0, 9.0}));
  EXPECT_EQ(task(tasks, "wave").wanted, (std::map<std::string, double>{{"trot", 9.0}}));
  EXPECT_EQ(task(tasks, "friction").levels, (std::vector<double>{0.5, 0.2}));
  EXPECT_EQ(task(tasks, "stairs").levels, task(terrain_tasks(), "stairs").levels);
}

TEST_F(TerrainLevelsTest, ARobotWithoutTheFileHasThoseOfAll) {
  RobotConfig robot = load_robot("pegasus");
  robot.folder = scratch_.path().string();
  const std::vector<TerrainTask> tasks = terrain_tasks_of(robot);
  ASSERT_EQ(tasks.size(), terrain_tasks().size());
  EXPECT_TRUE(tasks[0].wanted.empty());
}

TEST_F(TerrainLevelsTest, WhatCannotBeTriedIsRefusedAtItsLine) {
  const auto with = [](const std::string& line) { return "robot: pegasus\ntasks:\n  " + line + "\n"; };
  EXPECT_NE(refusal(with("wave: {levels: [9 mm, 5 mm, 7 mm]}")).find("terrain.yaml:3"), std::string::npos);
  EXPECT_NE(refusal(with("wave: {levels: [5 mm, 9 mm], wanted: {trot: 7 mm}}")).find("none of this task's"),
            std::string::npos);
  EXPECT_NE(refusal(with("wave: {levels: [5 mm], wanted: {gallop: 5 mm}}")).find("gallop"),
            std::string::npos);
  EXPECT_NE(refusal(with("waves: {levels: [5 mm]}")).find("wave"), std::string::npos);
  EXPECT_NE(refusal(with("wave: {levels: [5 m]}")).find("mm"), std::string::npos);
  EXPECT_NE(refusal("robot: fennec\ntasks: {}\n").find("pegasus"), std::string::npos);
}

TEST_F(TerrainLevelsTest, ShippedQuadrupedsHaveLevelsForEveryTask) {
  for (const char* name : {"pegasus", "fennec"}) {
    const std::string text = text_of_file(load_robot(name).folder + "/terrain.yaml");
    for (const TerrainTask& one : terrain_tasks())
      EXPECT_NE(text.find("\n  " + one.name + ": {"), std::string::npos) << name << " " << one.name;
    EXPECT_NO_THROW(terrain_tasks_of(load_robot(name)));
  }
}

}  // namespace
}  // namespace sprung
