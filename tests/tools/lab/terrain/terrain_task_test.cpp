#include "tools/lab/terrain/terrain_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"

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
  }
}

TEST(TerrainTask, AWorldsLevelsAreSharesOfItsHeights) {
  const TerrainTask hills = world_task("some/where/hills.yaml");
  EXPECT_EQ(hills.name, "hills");
  EXPECT_NE(std::find(hills.levels.begin(), hills.levels.end(), 1.0), hills.levels.end());
  EXPECT_EQ(hills.plant(load_robot("pegasus"), 0.5, 1.0).at("ground_scale"), 0.5);
}

/// Levels are shares of what the world's file says: they hold as long as it says that.
TEST(TerrainTask, LevelsOfStairsAndRubbleAreTheirTallestStep) {
  const RobotConfig robot = load_robot("pegasus");
  for (const char* name : {"stairs", "rough"}) {
    double tallest_m = 0.0;
    for (const sim::GroundStep& step :
         sim::load_sim_config(robot, task(name).plant(robot, 40.0, 1.0)).plant.ground.steps)
      tallest_m = std::max(tallest_m, step.height_m);
    EXPECT_NEAR(tallest_m, 0.040, 1e-12) << name;
  }
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

/// Felt, not seen: it fell at the first riser of 40 mm before feet that are held up began their swing anew.
TEST(TerrainTask, StairsAreCrawledUp) {
  TerrainRun asked;
  asked.gait = "crawl";
  asked.speed_m_s = 0.09;
  asked.distance_m = 1.2;
  SimOptions sim;
  sim.plant = {{"draw", 1001.0}};
  const TerrainRun run = walk_terrain(load_robot("pegasus"), "best", sim, task("stairs"), 40.0, asked);
  EXPECT_EQ(run.why, "");
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
