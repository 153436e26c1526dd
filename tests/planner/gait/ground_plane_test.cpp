#include "planner/gait/ground_plane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

constexpr double kGroundStep_s = 0.002, kPeriod_s = 0.6;
const Eigen::Vector2d kPlaces_m[] = {{0.35, 0.18}, {0.35, -0.18}, {-0.35, 0.18}, {-0.35, -0.18}};

/// Four feet on a plane 0.5 m below.
GroundPlane::Feet standing(double z_m, const Eigen::Vector2d& slope = Eigen::Vector2d::Zero(),
                           const Eigen::Vector2d& by_m = Eigen::Vector2d::Zero()) {
  GroundPlane::Feet feet{};
  for (std::size_t i = 0; i < feet.size(); ++i) {
    feet[i].at_m << kPlaces_m[i] + by_m, z_m + slope.dot(kPlaces_m[i] + by_m);
    feet[i].stands = true;
  }
  return feet;
}

class GroundPlaneTest : public testing::Test {
 protected:
  GroundPlaneTest() {
    ground_.begin(standing(-0.5), 0.0);
    follow(standing(-0.5));
  }
  void follow(const GroundPlane::Feet& feet, int cycles = 1) {
    for (int k = 0; k < cycles; ++k) ground_.follow(feet, yaw_rad_, kPeriod_s, kGroundStep_s);
  }
  double yaw_rad_ = 0.0;
  GroundPlane ground_;
};

TEST_F(GroundPlaneTest, TrunkThatSinksIsFollowedAtOnce) {
  follow(standing(-0.49));
  EXPECT_NEAR(ground_.z_m(), -0.49, 1e-12);
  EXPECT_NEAR(ground_.sunk_m(), 0.01, 1e-12);
  follow(standing(-0.49));
  EXPECT_NEAR(ground_.sunk_m(), 0.0, 1e-12);
}

TEST_F(GroundPlaneTest, FootThatLandsOnOtherGroundTeachesItSlowly) {
  GroundPlane::Feet feet = standing(-0.5);
  feet[2].stands = false;
  follow(feet);
  feet[2].at_m.z() = -0.46;
  feet[2].stands = true;
  follow(feet);
  EXPECT_NEAR(ground_.sunk_m(), 0.0, 1e-12);
  EXPECT_NEAR(ground_.z_m(), -0.5 + 0.1 * kGroundStep_s, 1e-12);
  follow(feet, 2000);
  EXPECT_NEAR(ground_.z_m(), -0.49, 1e-6);  // the mean of four
}

TEST_F(GroundPlaneTest, FeetInTheAirSayNothing) {
  GroundPlane::Feet feet = standing(-0.5);
  feet[0].stands = false;
  feet[0].at_m.z() = -0.3;
  follow(feet, 500);
  EXPECT_NEAR(ground_.z_m(), -0.5, 1e-12);
  EXPECT_NEAR(ground_.slope().norm(), 0.0, 1e-12);
  for (GroundFoot& foot : feet) foot.stands = false;
  follow(feet);
  EXPECT_NEAR(ground_.z_m(), -0.5, 1e-12);
  EXPECT_EQ(ground_.sunk_m(), 0.0);
}

TEST_F(GroundPlaneTest, BeginsAnewWithoutWhatWasBefore) {
  follow(standing(-0.5, {0.1, 0.0}), 1000);
  ground_.begin(standing(-0.3), 0.0);
  follow(standing(-0.3));
  EXPECT_NEAR(ground_.z_m(), -0.3, 1e-12);
  EXPECT_EQ(ground_.slope().norm(), 0.0);
  EXPECT_EQ(ground_.sunk_m(), 0.0);
}

TEST_F(GroundPlaneTest, BeginsWithTheSlopeUnderItsFeet) {
  const Eigen::Vector2d slope(0.15, -0.1);
  ground_.begin(standing(-0.5, slope), 0.3);
  EXPECT_NEAR(ground_.z_m(), -0.5, 1e-12);
  EXPECT_NEAR((ground_.slope() - slope).norm(), 0.0, 2e-3);  // held back by the least spread
  EXPECT_NEAR(ground_.z_m({1.0, 0.0, 7.0}), -0.5 + ground_.slope().x(), 1e-12);
}

/// A trunk at a constant height over a plane does not sink, though its feet do.
TEST_F(GroundPlaneTest, ClimbingIsNoSinking) {
  const Eigen::Vector2d slope(0.2, 0.0);
  ground_.begin(standing(-0.5, slope), 0.0);
  follow(standing(-0.5, slope));
  follow(standing(-0.5, slope, {-0.001, 0.0}));
  EXPECT_NEAR(ground_.sunk_m(), 0.0, 5e-6);
  EXPECT_NEAR(ground_.z_m(), -0.5, 5e-6);
}

/// Two feet at a time stand, and the others' prints go by under the trunk: level ground, then a ramp.
TEST_F(GroundPlaneTest, LearnsARampFromStepsOfDiagonalPairs) {
  constexpr double kSpeed_m_s = 0.3, kHalf_s = 0.3, kRamp = 0.15;
  std::array<double, 4> foot_x_m{};  // in the world
  for (std::size_t i = 0; i < 4; ++i) foot_x_m[i] = kPlaces_m[i].x();
  const auto height_m = [](double x_m) { return x_m > 0.5 ? kRamp * (x_m - 0.5) : 0.0; };
  double body_m = 0.0;
  for (int half = 0; half < 16; ++half) {
    for (double t = 0.0; t < kHalf_s; t += kGroundStep_s) {
      body_m += kSpeed_m_s * kGroundStep_s;
      GroundPlane::Feet feet{};
      for (std::size_t i = 0; i < 4; ++i) {
        feet[i].stands = (half % 2 == 0) == (i == 0 || i == 3);
        if (!feet[i].stands) foot_x_m[i] = body_m + kPlaces_m[i].x() + 0.5 * kSpeed_m_s * kHalf_s;
        feet[i].at_m << foot_x_m[i] - body_m, kPlaces_m[i].y(),
            height_m(foot_x_m[i]) - height_m(body_m) - 0.5;
      }
      follow(feet);
    }
  }
  EXPECT_NEAR(ground_.slope().x(), kRamp, 0.01);
  EXPECT_NEAR(ground_.slope().y(), 0.0, 0.01);
}

TEST_F(GroundPlaneTest, StonesAreNoSlopeUntilTheyAreBehind) {
  const GroundPlane::Feet slope = standing(-0.5, {0.1, 0.0});
  GroundPlane::Feet stones = slope;
  for (const auto& [foot, up_m] : {std::pair{0, 0.02}, {1, -0.02}, {2, -0.02}, {3, 0.02}})
    stones[static_cast<std::size_t>(foot)].at_m.z() += up_m;
  GroundPlane smooth = ground_;
  follow(stones, 300);
  for (int k = 0; k < 300; ++k) smooth.follow(slope, 0.0, kPeriod_s, kGroundStep_s);
  EXPECT_GT(smooth.slope().x(), 0.07);
  EXPECT_LT(ground_.slope().x(), 0.015);
  const double before = ground_.slope().x();
  follow(slope, 300);
  EXPECT_LT(ground_.slope().x() - before, 0.025);  // half a second later they still count
  follow(slope, 4000);
  EXPECT_NEAR(ground_.slope().x(), 0.1, 0.003);
}

/// Between one ground and the next footprints lie in no plane either: but on a ramp all say the same way.
TEST_F(GroundPlaneTest, RoughFootprintsThatKeepSlopingOneWayAreARampAndThoseThatDoNotAreStones) {
  const auto rough = [](double slope) {
    GroundPlane::Feet feet = standing(-0.5, {slope, 0.0});
    feet[0].at_m.z() += 0.02;
    feet[3].at_m.z() += 0.02;
    return feet;
  };
  GroundPlane stones = ground_;
  for (int period = 0; period < 8; ++period) {
    const double to_and_fro = period % 2 == 0 ? 0.15 : -0.15;
    follow(rough(0.15), 300);
    for (int k = 0; k < 300; ++k) stones.follow(rough(to_and_fro), 0.0, kPeriod_s, kGroundStep_s);
    EXPECT_LT(std::abs(stones.slope().x()), 0.06) << period;
  }
  EXPECT_GT(ground_.slope().x(), 0.13);
}

TEST_F(GroundPlaneTest, BeginsWithoutStonesOrSlopesOfBefore) {
  GroundPlane::Feet stones = standing(-0.5, {0.1, 0.0});
  stones[0].at_m.z() += 0.05;
  follow(stones, 300);
  GroundPlane::Feet none{};
  ground_.begin(none, 0.0);
  EXPECT_EQ(ground_.expected_z_m({1.0, 1.0, 0.0}), 0.0);
  GroundPlane fresh;
  fresh.begin(none, 0.0);
  for (int k = 0; k < 50; ++k) {
    ground_.follow(standing(-0.5, {0.1, 0.0}), 0.0, kPeriod_s, kGroundStep_s);
    fresh.follow(standing(-0.5, {0.1, 0.0}), 0.0, kPeriod_s, kGroundStep_s);
  }
  EXPECT_EQ(ground_.slope().x(), fresh.slope().x());
}

TEST_F(GroundPlaneTest, NextFootIsExpectedByTheNewestFootprintsBeforeTheTrunkFollows) {
  GroundPlane::Feet feet = standing(-0.5);
  for (const std::size_t front : {0, 1}) feet[front].at_m.z() = -0.49;  // symmetric: a plane, no stones
  follow(feet);
  const Eigen::Vector3d ahead_m(0.5, 0.0, 0.0);
  EXPECT_NEAR(ground_.expected_z_m(ahead_m) - ground_.z_m(), 0.5 * 0.01 / 0.7, 2e-4);
  EXPECT_LT(ground_.z_m(ahead_m) - ground_.z_m(), 0.001);
  ground_.begin(standing(-0.5), 0.0);
  feet = standing(-0.5);
  feet[0].at_m.z() = feet[3].at_m.z() = -0.44;  // a stone under every second foot
  feet[0].at_m.z() = -0.42;
  follow(feet);
  EXPECT_LT(ground_.expected_z_m(ahead_m) - ground_.z_m(), 0.003);
}

TEST_F(GroundPlaneTest, SlopeTurnsAwayFromATrunkThatTurns) {
  ground_.begin(standing(-0.5, {0.2, 0.0}), 0.0);
  GroundPlane::Feet in_the_air = standing(-0.5, {0.2, 0.0});
  for (GroundFoot& foot : in_the_air) foot.stands = false;
  const double before = ground_.slope().norm();
  for (int k = 1; k <= 100; ++k) {
    yaw_rad_ = 0.5 * 3.14159265 * k / 100.0;
    follow(in_the_air);
  }
  EXPECT_NEAR(ground_.slope().x(), 0.0, 0.01);
  EXPECT_NEAR(ground_.slope().y(), -before, 0.01);  // what was ahead is at the right
}

TEST_F(GroundPlaneTest, TwoFeetShowNoSlopeAndNothingIsSteeperThanTheSteepest) {
  GroundPlane::Feet two = standing(-0.5, {0.2, 0.0});
  two[0].stands = two[3].stands = false;
  ground_.begin(two, 0.0);
  EXPECT_EQ(ground_.slope().norm(), 0.0);
  ground_.begin(standing(-0.5, {2.0, 0.0}), 0.0);
  EXPECT_NEAR(ground_.slope().norm(), GroundPlane::kSteepest, 1e-12);
}

TEST_F(GroundPlaneTest, BoundsAreOfKinematicsOnSmoothGroundAndGrowWithStones) {
  EXPECT_NEAR(ground_.z_bound_m(), 0.01, 1e-3);
  // 5 mm at four feet, 0.35 m before and behind, 0.18 m beside
  EXPECT_NEAR(ground_.slope_bound().x(), 2.0 * 0.005 / 0.7, 1e-3);
  EXPECT_NEAR(ground_.slope_bound().y(), 2.0 * 0.005 / 0.36, 2e-3);
  const double smooth_m = ground_.z_bound_m();
  GroundPlane::Feet stone = standing(-0.5);
  stone[0].at_m.z() += 0.04;
  follow(stone, 50);
  EXPECT_GT(ground_.z_bound_m(), 2.0 * smooth_m);
}

}  // namespace
}  // namespace sprung
