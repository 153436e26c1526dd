#include "tools/lab/jump/jump_ensemble.h"

#include <gtest/gtest.h>

#include <set>

#include "robots/robot_loader.h"
#include "signals/vec3.h"

namespace sprung {
namespace {

const ReportRow& jump_ensemble_find(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows) {
    if (row.name == name) return row;
  }
  throw std::out_of_range(name);
}

TEST(JumpEnsemble, DrawsAreWithinTheBoxAndRepeatable) {
  const std::vector<JumpPlant> plants = jump_plants(1, 1, 50), again = jump_plants(1, 2, 50);
  std::set<std::uint64_t> seeds;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const auto within = [&](const char* key, double low, double high) {
      EXPECT_GE(plants[i].changes.at(key), low) << key;
      EXPECT_LE(plants[i].changes.at(key), high) << key;
    };
    within("friction_scale", 0.8, 1.2);
    within("mass_scale", 0.9, 1.1);
    within("kt_scale", 0.95, 1.05);
    within("ground_stiffness", 6000.0, 12000.0);
    EXPECT_EQ(plants[i].changes, again[i].changes);
    seeds.insert(plants[i].seed);
  }
  EXPECT_EQ(seeds.size(), 50u);
  EXPECT_NE(again[0].seed, plants[0].seed) << "a seed is of the noise alone";
  EXPECT_NE(jump_plants(0, 1, 1)[0].changes, plants[0].changes);
}

TEST(JumpEnsemble, GroundsAreNamedAfterTheirStiffness) {
  const std::vector<JumpPlant> grounds = ground_sweep(3);
  ASSERT_EQ(grounds.size(), 5u);
  EXPECT_EQ(grounds[1].name, "8.2");
  EXPECT_DOUBLE_EQ(grounds[1].changes.at("ground_stiffness"), 8200.0);
}

TEST(JumpEnsemble, RowsHoldTheWorstHeightAndCountFallsAndTrips) {
  JumpEnsemble ensemble;
  ensemble.asked_mm = 200.0;
  ensemble.plants.resize(3);
  for (JumpOutcome& plant : ensemble.plants) plant.first_mm = plant.adapted_mm = 200.0;
  ensemble.plants[1].first_mm = 150.0;
  ensemble.plants[2].adapted_mm = 220.0;
  ensemble.grounds = {{{"60", {}, 1}, false, false, 120.0, 165.0, 0.0}};
  std::vector<ReportRow> rows = jump_ensemble_rows(ensemble);
  EXPECT_DOUBLE_EQ(jump_ensemble_find(rows, "jump_ensemble.all.worst_first").value, 0.25);
  EXPECT_NEAR(jump_ensemble_find(rows, "jump_ensemble.all.worst_adapted").value, 0.10, 1e-12);
  EXPECT_TRUE(jump_ensemble_find(rows, "jump_ensemble.all.worst_adapted").ok());
  EXPECT_TRUE(jump_ensemble_find(rows, "jump_ensemble.all.falls").ok());
  EXPECT_DOUBLE_EQ(jump_ensemble_find(rows, "jump_ensemble.ground.60.first").value, 120.0);
  EXPECT_FALSE(jump_ensemble_find(rows, "jump_ensemble.ground.60.adapted").ok());
  ensemble.plants[0].fell = ensemble.plants[0].tripped = true;
  ensemble.plants[0].adapted_mm = kNaN;
  rows = jump_ensemble_rows(ensemble);
  EXPECT_FALSE(jump_ensemble_find(rows, "jump_ensemble.all.falls").ok());
  EXPECT_FALSE(jump_ensemble_find(rows, "jump_ensemble.all.trips").ok());
  EXPECT_FALSE(jump_ensemble_find(rows, "jump_ensemble.all.worst_adapted").ok());
}

TEST(JumpEnsemble, PlantIsJumpedOnThreeTimesWithTheSameBits) {
  const RobotConfig robot = load_robot("single_leg");
  const JumpPlant plant = jump_plants(0, 0, 1)[0];
  const JumpOutcome outcome = jump_on(robot, {}, plant), again = jump_on(robot, {}, plant);
  EXPECT_FALSE(outcome.fell);
  EXPECT_FALSE(outcome.tripped);
  EXPECT_GT(outcome.first_mm, 100.0);
  EXPECT_EQ(outcome.first_mm, again.first_mm);
  EXPECT_EQ(outcome.adapted_mm, again.adapted_mm);
}

TEST(JumpEnsemble, HeightThatIsRefusedIsATripAndAFall) {
  JumpEnsembleRequest request;
  request.height_m = 2.0;
  const JumpOutcome outcome = jump_on(load_robot("single_leg"), request, {"nominal", {}, 1});
  EXPECT_TRUE(outcome.tripped);
  EXPECT_TRUE(outcome.fell);
}

}  // namespace
}  // namespace sprung
