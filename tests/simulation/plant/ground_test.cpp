#include "simulation/plant/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "signals/angles.h"

namespace sprung::sim {
namespace {

TEST(Ground, IsFlatAndLevelByItself) {
  const Ground ground(GroundConfig{}, 0.3, 2);
  EXPECT_FALSE(ground.uneven());
  for (const double x : {-5.0, 0.0, 0.7}) {
    const Ground::Place place = ground.under(1, x, 2.0);
    EXPECT_EQ(place.point_m[2], 0.3);
    EXPECT_EQ(place.normal, (Vec3{0, 0, 1}));
  }
}

TEST(Ground, RisesForwardAndToTheLeftByItsSlopes) {
  GroundConfig config;
  config.slope_rad = 0.2;
  config.side_slope_rad = -0.1;
  const Ground ground(config, 0.0, 1);
  EXPECT_TRUE(ground.uneven());
  const Ground::Place place = ground.under(0, 2.0, 3.0);
  EXPECT_NEAR(place.point_m[2], 2.0 * std::tan(0.2) - 3.0 * std::tan(0.1), 1e-12);
  EXPECT_NEAR(place.normal[0] / place.normal[2], -std::tan(0.2), 1e-12);
  EXPECT_NEAR(place.normal[1] / place.normal[2], std::tan(0.1), 1e-12);
  // The trunk's plane is the same one.
  EXPECT_NEAR(ground.below(0.5, 0.7).distance_m(place.point_m), 0.0, 1e-12);
}

/// Level ground before, and everywhere a gradient that is its own height's.
TEST(Ground, SlopesAndWavesBeginWhereTheyAreSaidTo) {
  GroundConfig config;
  config.slope_rad = 0.2;
  config.side_slope_rad = 0.1;
  config.begins_m = 1.0;
  config.wave_m = 0.03;
  config.wave_length_m = 0.8;
  const Ground ground(config, 0.0, 1);
  EXPECT_TRUE(ground.uneven());
  EXPECT_EQ(ground.under(0, 0.9, 0.5).point_m[2], 0.0);
  EXPECT_EQ(ground.under(0, 0.9, 0.5).normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(ground.under(0, 1.0 + 2.0, 0.2).point_m[2],
              2.0 * std::tan(0.2) + 0.2 * std::tan(0.1) +
                  0.03 * std::sin(2.0 / 0.8 * kTurn_rad) * std::cos(0.2 / 0.8 * kTurn_rad),
              1e-9);
  constexpr double kNear_m = 1e-6;
  for (const double x : {1.3, 1.9, 2.5, 4.4})
    for (const double y : {-0.3, 0.0, 0.25}) {
      const auto height_m = [&](double dx, double dy) { return ground.under(0, x + dx, y + dy).point_m[2]; };
      const Vec3 normal = ground.under(0, x, y).normal;
      EXPECT_NEAR(-normal[0] / normal[2], (height_m(kNear_m, 0) - height_m(-kNear_m, 0)) / (2 * kNear_m),
                  1e-6);
      EXPECT_NEAR(-normal[1] / normal[2], (height_m(0, kNear_m) - height_m(0, -kNear_m)) / (2 * kNear_m),
                  1e-6);
      EXPECT_NEAR(ground.below(x, y).point_m[2], height_m(0, 0), 1e-12);
    }
}

TEST(Ground, WavesEverywhereAreAsHighAsTheyAreSaidTo) {
  GroundConfig config;
  config.wave_m = 0.03;
  const Ground ground(config, 0.1, 1);
  EXPECT_NEAR(ground.under(0, 0.25, 0.0).point_m[2], 0.13, 1e-12);
  EXPECT_NEAR(ground.under(0, -0.25, 0.0).point_m[2], 0.07, 1e-12);
}

TEST(Ground, StepIsItsHeightInsideAndRampsAtItsEdges) {
  GroundConfig config;
  config.steps = {{{1.0, 0.5, -0.2, 0.4}, 0.02}};  // x 1.0 to 1.5, y -0.2 to 0.2
  const Ground ground(config, 0.0, 1);
  EXPECT_EQ(ground.under(0, 1.25, 0.0).point_m[2], 0.02);
  EXPECT_EQ(ground.under(0, 1.25, 0.0).normal[2], 1.0);
  for (const auto& [x, y] : {std::pair{0.99, 0.0}, {1.51, 0.0}, {1.25, 0.21}, {1.25, -0.21}})
    EXPECT_EQ(ground.under(0, x, y).point_m[2], 0.0) << x << ' ' << y;
  EXPECT_NEAR(ground.under(0, 1.01, 0.0).point_m[2], 0.01, 1e-12);
  EXPECT_LT(ground.under(0, 1.01, 0.0).normal[0], -0.5);  // 45 degrees, against who comes
  EXPECT_GT(ground.under(0, 1.49, 0.0).normal[0], 0.5);
  EXPECT_LT(ground.under(0, 1.25, -0.19).normal[1], -0.5);
}

TEST(Ground, StepWithoutLengthAndWidthGoesOn) {
  GroundConfig config;
  config.steps = {{{1.0, 0.0, 0.0, 0.0}, -0.1}};
  const Ground ground(config, 0.0, 1);
  EXPECT_EQ(ground.under(0, 50.0, -7.0).point_m[2], -0.1);
  EXPECT_EQ(ground.under(0, 0.9, -7.0).point_m[2], 0.0);
}

void expect_own_gradients(const Ground& ground, double x, double y) {
  constexpr double kNear_m = 1e-6;
  const auto height_m = [&](double dx, double dy) { return ground.under(0, x + dx, y + dy).point_m[2]; };
  const Vec3 normal = ground.under(0, x, y).normal;
  const double along = (height_m(kNear_m, 0) - height_m(-kNear_m, 0)) / (2 * kNear_m);
  const double across = (height_m(0, kNear_m) - height_m(0, -kNear_m)) / (2 * kNear_m);
  EXPECT_NEAR(-normal[0] / normal[2], along, 1e-6) << x << ", " << y;
  EXPECT_NEAR(-normal[1] / normal[2], across, 1e-6) << x << ", " << y;
}

TEST(Ground, RoughFloorIsSmoothWithinItsHeightsAndOfItsSeed) {
  GroundConfig config;
  config.rough_m = 0.03;
  config.rough_grid_m = 0.25;
  const Ground ground(config, 0.0, 1);
  EXPECT_TRUE(ground.uneven());
  config.error_seed = 2;
  const Ground another(config, 0.0, 1);
  std::set<double> heights;
  int differ = 0;
  for (double x = -1.03; x < 1.0; x += 0.11)
    for (double y = -0.97; y < 1.0; y += 0.13) {
      const double height_m = ground.under(0, x, y).point_m[2];
      EXPECT_LE(std::abs(height_m), 0.03);
      heights.insert(height_m);
      differ += height_m != another.under(0, x, y).point_m[2] ? 1 : 0;
      expect_own_gradients(ground, x, y);
    }
  EXPECT_GT(heights.size(), 200u);
  EXPECT_GT(differ, 200);
}

TEST(Ground, RampsFollowOneAnotherFromTheHeightThatWasReached) {
  GroundConfig config;
  config.ramps = {{1.0, 2.0, 0.1}, {4.0, 1.0, -0.2}};
  const Ground ground(config, 0.5, 1);
  EXPECT_TRUE(ground.uneven());
  const double top_m = 0.5 + 2.0 * std::tan(0.1);
  EXPECT_EQ(ground.under(0, 0.9, 0).point_m[2], 0.5);
  EXPECT_NEAR(ground.under(0, 3.5, 7).point_m[2], top_m, 1e-12);
  EXPECT_NEAR(ground.below(9.0, 0).point_m[2], top_m - std::tan(0.2), 1e-12);
  for (const double x : {0.5, 1.5, 3.5, 4.5, 6.0}) expect_own_gradients(ground, x, 0.3);
}

TEST(Ground, LastPatchThatLiesThereHasTheFriction) {
  GroundConfig config;
  config.patches = {{{1.0, 1.0, 0.0, 0.0}, 0.2}, {{1.5, 0.0, -0.5, 0.5}, 0.3}};
  const Ground ground(config, 0.0, 1);
  EXPECT_TRUE(ground.slippery_in_places());
  EXPECT_FALSE(ground.uneven());
  EXPECT_EQ(ground.friction(0.9, 0.0, 0.6), 0.6);
  EXPECT_EQ(ground.friction(1.2, -7.0, 0.6), 0.2);
  EXPECT_EQ(ground.friction(1.7, -0.2, 0.6), 0.3);
  EXPECT_EQ(ground.friction(1.7, 0.2, 0.6), 0.2);
  EXPECT_EQ(ground.friction(99.0, -0.2, 0.6), 0.3);
  EXPECT_EQ(ground.friction(99.0, 0.2, 0.6), 0.6);
}

TEST(Ground, HeightsAreScaledAndWaysAreNot) {
  GroundConfig config;
  config.slope_rad = 0.1;
  config.wave_m = 0.02;
  config.rough_m = 0.01;
  config.steps = {{{1.0, 0.5}, 0.04}};
  config.ramps = {{2.0, 1.0, -0.1}};
  const Ground by_itself(config, 0.0, 1);
  config.scale_heights(2.5);
  const Ground scaled(config, 0.0, 1);
  for (const double x : {0.3, 1.01, 1.2, 2.7, 4.0})
    EXPECT_NEAR(scaled.below(x, 0.2).point_m[2], 2.5 * by_itself.below(x, 0.2).point_m[2], 1e-12);
}

TEST(Ground, HeightIsOfOneLegOrOfAll) {
  Ground ground(GroundConfig{}, 0.0, 3);
  ground.set_height(1, 0.02);
  EXPECT_EQ(ground.under(0, 0, 0).point_m[2], 0.0);
  EXPECT_EQ(ground.under(1, 0, 0).point_m[2], 0.02);
  EXPECT_EQ(ground.below(0, 0).point_m[2], 0.0);
  ground.set_height(-1, -0.1);
  for (std::size_t leg = 0; leg < 3; ++leg) EXPECT_EQ(ground.under(leg, 0, 0).point_m[2], -0.1);
  ground.set_height(3, 9.0);  // no such leg
  ground.reset();
  EXPECT_EQ(ground.under(1, 0, 0).point_m[2], 0.0);
}

TEST(Ground, StoneStaysWhileTheFootIsDownAndIsDrawnAnewWhenItIsAboveAll) {
  GroundConfig config;
  config.error_m = 0.02;
  Ground ground(config, 0.0, 1);
  const auto height = [&] { return ground.under(0, 0, 0).point_m[2]; };
  ground.notice(0, {0, 0, 0.001});
  EXPECT_EQ(height(), 0.0);
  ground.notice(0, {0, 0, 0.024});
  EXPECT_EQ(height(), 0.0);
  ground.notice(0, {0, 0, 0.026});
  const double first = height();
  EXPECT_NE(first, 0.0);
  ground.notice(0, {0, 0, 0.05});
  ground.notice(0, {0, 0, first});
  EXPECT_EQ(height(), first);
  ground.notice(0, {0, 0, 0.05});
  EXPECT_NE(height(), first);
}

/// Heights of the stones that a leg finds.
std::vector<double> stones(std::uint64_t seed, std::size_t leg, int count) {
  GroundConfig config;
  config.error_m = 0.02;
  config.error_seed = seed;
  Ground ground(config, 0.0, 4);
  std::vector<double> found;
  while (count-- > 0) {
    ground.notice(leg, {0, 0, 0.1});
    ground.notice(leg, {0, 0, 0.0});
    found.push_back(ground.under(leg, 0, 0).point_m[2]);
  }
  return found;
}

TEST(Ground, StonesAreSeededUniformAndOfEachLegItsOwn) {
  const std::vector<double> found = stones(1, 0, 4000);
  double sum = 0.0, squares = 0.0, most = 0.0;
  for (const double height : found) {
    sum += height;
    squares += height * height;
    most = std::max(most, std::abs(height));
  }
  EXPECT_LE(most, 0.02);
  EXPECT_GT(most, 0.0199);
  EXPECT_NEAR(sum / 4000, 0.0, 0.0006);  // 3 sigma of a uniform's mean
  EXPECT_NEAR(std::sqrt(squares / 4000), 0.02 / std::sqrt(3.0), 0.0003);
  EXPECT_EQ(stones(1, 0, 5), stones(1, 0, 5));
  EXPECT_NE(stones(1, 0, 5), stones(2, 0, 5));
  EXPECT_NE(stones(1, 0, 5), stones(1, 1, 5));
}

}  // namespace
}  // namespace sprung::sim
