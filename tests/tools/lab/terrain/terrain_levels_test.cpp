#include "tools/lab/terrain/terrain_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"

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
    return test::refusal_of<ConfigError>([&] { of(text); });
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
      "  friction: {levels: [0.5, 0.2]}\n"
      "  stairs: {wanted: {crawl: 40 mm}}\n");
  EXPECT_EQ(tasks.size(), terrain_tasks().size());
  EXPECT_EQ(task(tasks, "wave").levels, (std::vector<double>{5.0, 9.0}));
  EXPECT_EQ(task(tasks, "wave").wanted, (std::map<std::string, double>{{"trot", 9.0}}));
  EXPECT_EQ(task(tasks, "friction").levels, (std::vector<double>{0.5, 0.2}));
  EXPECT_EQ(task(tasks, "stairs").levels, task(terrain_tasks(), "stairs").levels);
  EXPECT_EQ(task(tasks, "stairs").wanted.at("crawl"), 40.0);
  EXPECT_EQ(task(tasks, "rough").levels, task(terrain_tasks(), "rough").levels);
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

TEST_F(TerrainLevelsTest, FennecIsTriedOnSmallerHeightsAndLoadsThanPegasusOfWhichSomethingIsWanted) {
  const std::vector<TerrainTask> big = terrain_tasks_of(load_robot("pegasus"));
  const std::vector<TerrainTask> small = terrain_tasks_of(load_robot("fennec"));
  for (const char* name : {"wave", "stairs", "rough", "payload"})
    EXPECT_LT(task(small, name).levels.back(), task(big, name).levels.back()) << name;
  EXPECT_EQ(task(big, "slope_down").wanted, (std::map<std::string, double>{{"trot", 8.4}, {"crawl", 13.5}}));
}

}  // namespace
}  // namespace sprung
