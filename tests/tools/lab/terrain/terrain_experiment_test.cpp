#include "tools/lab/terrain/terrain_experiment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

TerrainTask slope() { return {"slope_up", "a ramp, up", "deg", {2.0, 4.0, 8.0}, {}, {{"trot", 4.0}}}; }

TerrainOutcome reached(const TerrainTask& task, const std::string& gait, int level) {
  TerrainOutcome out;
  out.task = &task;
  out.gait = gait;
  out.level = level;
  return out;
}

TEST(TerrainExperiment, RowIsTheHardestLevelAgainstWhatIsWantedOfThatGait) {
  const TerrainTask task = slope();
  EXPECT_EQ(terrain_row(reached(task, "trot", 1)).name, "terrain.slope_up.trot.level");
  EXPECT_EQ(terrain_row(reached(task, "trot", 2)).value, 8.0);
  EXPECT_TRUE(terrain_row(reached(task, "trot", 1)).ok());
  EXPECT_FALSE(terrain_row(reached(task, "trot", 0)).ok());
  EXPECT_TRUE(std::isnan(terrain_row(reached(task, "trot", -1)).value));
  EXPECT_FALSE(terrain_row(reached(task, "trot", -1)).ok());
  EXPECT_TRUE(terrain_row(reached(task, "amble", -1)).ok());  // nothing is wanted of it
}

TEST(TerrainExperiment, OfFrictionLessIsHarder) {
  TerrainTask task = slope();
  task.levels = {0.8, 0.4, 0.2};
  task.wanted = {{"trot", 0.4}};
  EXPECT_FALSE(terrain_row(reached(task, "trot", 0)).ok());
  EXPECT_TRUE(terrain_row(reached(task, "trot", 2)).ok());
}

TEST(TerrainExperiment, SectionTellsWhoDidNotPassAndWhy) {
  const TerrainTask task = slope();
  TerrainOutcome outcome = reached(task, "trot", 0);
  TerrainRun passed, fell;
  passed.draw = 1001;
  fell.draw = 1002;
  fell.why = "fell: tilted";
  outcome.tried = {{1, {passed, fell}}};
  EXPECT_EQ(outcome.tried.front().passed(), 1);
  const report::Section section = terrain_section(outcome);
  ASSERT_EQ(section.tables.size(), 1u);
  ASSERT_EQ(section.tables.front().rows.size(), 1u);
}

}  // namespace
}  // namespace sprung
