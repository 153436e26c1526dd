#include "tools/lab/estimation/estimator_ensemble.h"

#include <gtest/gtest.h>

#include <set>

namespace sprung {
namespace {

TEST(EstimatorEnsembleTest, HoldsTheNominalPlantEveryCornerAndDrawsWithinTheBox) {
  const std::vector<EnsemblePlant> plants = estimator_ensemble(1, 1);
  ASSERT_EQ(plants.size(), 21u);
  EXPECT_EQ(plants[0].changes.at("friction_scale"), 1.0);
  std::set<std::string> names;
  std::set<std::uint64_t> seeds;
  int corners = 0;
  for (const EnsemblePlant& plant : plants) {
    names.insert(plant.name);
    seeds.insert(plant.seed);
    const double friction = plant.changes.at("friction_scale"), kt = plant.changes.at("kt_scale"),
                 mass = plant.changes.at("mass_scale");
    EXPECT_GE(friction, 0.75);
    EXPECT_LE(friction, 1.25);
    EXPECT_GE(kt, 0.95);
    EXPECT_LE(kt, 1.05);
    EXPECT_GE(mass, 0.9);
    EXPECT_LE(mass, 1.1);
    const bool corner = (friction == 0.75 || friction == 1.25) && (kt == 0.95 || kt == 1.05) &&
                        (mass == 0.9 || mass == 1.1);
    corners += corner ? 1 : 0;
  }
  EXPECT_EQ(corners, 8);
  EXPECT_EQ(names.size(), plants.size());
  EXPECT_EQ(seeds.size(), plants.size());
}

TEST(EstimatorEnsembleTest, ASeedChangesTheNoiseAndAnEnsembleTheDraws) {
  const std::vector<EnsemblePlant> tuned = estimator_ensemble(0, 1), again = estimator_ensemble(0, 2),
                                   reported = estimator_ensemble(1, 1);
  for (std::size_t i = 0; i < tuned.size(); ++i) {
    EXPECT_EQ(tuned[i].changes, again[i].changes);
    EXPECT_NE(tuned[i].seed, again[i].seed);
    EXPECT_EQ(tuned[i].changes != reported[i].changes, tuned[i].name.rfind("draw", 0) == 0) << tuned[i].name;
  }
}

TEST(EstimatorPlants, ChangedPlantIsRepeatedWithItsOwnNoiseAndNotVariedOnceMore) {
  EXPECT_EQ(estimator_plants({7, {}, true}, 1).size(), estimator_ensemble(1, 7).size());
  const auto plants = estimator_plants({7, {{"draw", 3.0}}, true}, 1);
  ASSERT_EQ(plants.size(), 5u);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    EXPECT_EQ(plants[i].changes, (std::map<std::string, double>{{"draw", 3.0}}));
    EXPECT_EQ(plants[i].seed, 7001u + i);
  }
}

}  // namespace
}  // namespace sprung
