#include "tools/lab/terrain/terrain_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "robots/config_error.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

const TerrainTask& task(const std::string& name) {
  for (const TerrainTask& one : terrain_tasks())
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

TerrainRun trot(const std::string& name, double level) {
  TerrainRun asked;
  asked.gait = "trot";
  asked.speed_m_s = 0.35;
  asked.distance_m = 2.0;
  return walk_terrain(load_robot("pegasus"), "best", {}, task(name), level, asked);
}

TEST(TerrainTask, EveryOneHasLevelsOfGrowingDifficultyOnAPlantThatThereIs) {
  std::set<std::string> names;
  for (const TerrainTask& one : terrain_tasks()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    const bool grows = one.levels.back() > one.levels.front();
    EXPECT_TRUE(grows ? std::is_sorted(one.levels.begin(), one.levels.end())
                      : std::is_sorted(one.levels.rbegin(), one.levels.rend()))
        << one.name;
    SimOptions sim;
    sim.plant = one.plant(load_robot("pegasus"), one.levels.front(), 7.0);
    EXPECT_FALSE(sim.plant.empty());
    EXPECT_NO_THROW(SimCore(load_robot("pegasus"), sim)) << one.name;
    for (const auto& [gait, level] : one.wanted)
      EXPECT_NE(std::find(one.levels.begin(), one.levels.end(), level), one.levels.end()) << one.name;
  }
}

TEST(TerrainTask, AWorldsLevelsAreSharesOfItsHeights) {
  const TerrainTask hills = world_task("some/where/hills.yaml");
  EXPECT_EQ(hills.name, "hills");
  EXPECT_NE(std::find(hills.levels.begin(), hills.levels.end(), 1.0), hills.levels.end());
  EXPECT_EQ(hills.plant(load_robot("pegasus"), 0.5, 1.0).at("ground_scale"), 0.5);
}

TEST(TerrainTask, PayloadsLieAnywhereBetweenTheHipsWithTheDraw) {
  const RobotConfig robot = load_robot("pegasus");
  std::set<double> places_m;
  for (double draw = 1.0; draw <= 50.0; ++draw) {
    const auto plant = task("payload").plant(robot, 3.0, draw);
    EXPECT_EQ(plant.at("payload"), 3.0);
    EXPECT_LE(std::abs(plant.at("payload_x")), 0.33);
    EXPECT_LE(std::abs(plant.at("payload_y")), 0.12);
    places_m.insert(plant.at("payload_x"));
  }
  EXPECT_EQ(places_m.size(), 50u);
  EXPECT_GT(*places_m.rbegin() - *places_m.begin(), 0.5);
}

TEST(TerrainTask, TheHardestLevelIsFoundWithoutTryingAll) {
  for (int hardest = -1; hardest < 9; ++hardest) {
    int tried = 0;
    EXPECT_EQ(hardest_level(9,
                            [&](int level) {
                              ++tried;
                              return level <= hardest;
                            }),
              hardest);
    EXPECT_LE(tried, 4);
  }
}

TEST(TerrainTask, ARampIsTrottedUpFromLevelGround) {
  const TerrainRun run = trot("slope_up", 5.7);
  EXPECT_TRUE(run.passed()) << run.why;
  EXPECT_GT(run.went_m_s, 0.25);
  EXPECT_LT(run.went_m_s, 0.4);
}

TEST(TerrainTask, WhoFallsOrComesToNothingHasNotPassedAndSaysWhy) {
  const TerrainRun run = trot("slope_up", 30.0);
  EXPECT_FALSE(run.passed());
  EXPECT_FALSE(run.why.empty());
}

TEST(TerrainTask, APlantThatThereIsNotIsRefusedAndNoFailureOfTheRobot) {
  SimOptions sim;
  sim.plant["drow"] = 7.0;
  TerrainRun asked;
  asked.gait = "trot";
  asked.speed_m_s = asked.distance_m = 0.3;
  EXPECT_THROW(walk_terrain(load_robot("pegasus"), "best", sim, task("friction"), 0.8, asked), ConfigError);
}

}  // namespace
}  // namespace sprung
