#include "tools/lab/estimation/odometry_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

constexpr double kSigma_m = 0.1;

BodyState said(const Vec3& position_m, const Vec3& velocity_m_s = {}) {
  BodyState out;
  out.estimated_position_in_world_m = position_m;
  out.estimated_quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
  out.estimated_velocity_m_s = velocity_m_s;
  for (const std::size_t i : {0, 4, 8}) {
    out.position_covariance_m2[i] = kSigma_m * kSigma_m;
    out.velocity_covariance_m2_s2[i] = 0.01 * 0.01;
  }
  return out;
}

/// A quarter turn to the left of what the robot calls ahead, and somewhere else.
SimTruth truth(double ahead_m, double speed_m_s = 0.0) {
  SimTruth out;
  out.base_in_world_m = {5.0, 3.0 + ahead_m, 0.4};
  out.base_velocity_m_s = {0.0, speed_m_s, 0.0};
  out.base_quaternion_wxyz = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  return out;
}

TEST(OdometryScore, ErrorsAreOfTheWayFromWhereTheEstimateBeganWhateverItsWorldIs) {
  OdometryScore score;
  score.add(BodyState{}, truth(-1.0));  // nothing is known yet
  EXPECT_FALSE(score.begun());
  score.add(said({1.0, 0.0, 0.0}), truth(0.0));
  score.add(said({3.0, 0.0, 0.0}), truth(2.0));
  EXPECT_NEAR(score.way_m(), 2.0, 1e-12);
  EXPECT_NEAR(score.position_error_m(), 0.0, 1e-12);
  score.add(said({4.1, 0.2, 0.0}), truth(3.0));
  EXPECT_NEAR(score.position_error_m(), std::hypot(0.1, 0.2), 1e-12);
  EXPECT_NEAR(score.position_nees(), 5.0, 1e-9);
  EXPECT_NEAR(score.heading_error_rad(), 0.0, 1e-12);
}

TEST(OdometryScore, TiltCountsOfItsOwnOnceTheRobotHasTurned) {
  OdometryScore score;
  const auto at = [](double heading_rad) {
    SimTruth out = truth(0.0);
    out.base_quaternion_wxyz = {std::cos(0.5 * heading_rad), 0.0, 0.0, std::sin(0.5 * heading_rad)};
    return out;
  };
  const auto tilted = [](double tilt_rad, double heading_rad) {
    BodyState out = said({});
    const double c = std::cos(0.5 * heading_rad), s = std::sin(0.5 * heading_rad);
    out.estimated_quaternion_wxyz = {c, 0.5 * tilt_rad * c, 0.5 * tilt_rad * s, s};
    return out;
  };
  score.add(tilted(0.02, 0.0), at(0.0));
  score.add(tilted(0.03, 1.0), at(1.0));
  EXPECT_NEAR(score.worst_tilt_rad(), 0.03, 1e-4);
  EXPECT_TRUE(std::isnan(score.worst_tilt_when_turned_rad()));
  score.add(tilted(0.01, -0.6), at(-0.6));
  score.add(tilted(0.005, 0.0), at(0.0));
  EXPECT_NEAR(score.worst_tilt_when_turned_rad(), 0.01, 1e-4);
}

TEST(OdometryScore, SwayingIsNoWay) {
  OdometryScore score;
  for (int k = 0; k < 100; ++k) score.add(said({}), truth(k % 2 == 0 ? 0.1 : -0.1));
  EXPECT_EQ(score.way_m(), 0.0);
}

TEST(OdometryScore, VelocityIsThatOfTheTrunkAndItsSurenessAnAverage) {
  OdometryScore score;
  score.add(said({}, {0.3, 0.0, 0.0}), truth(0.0, 0.3));
  score.add(said({}, {0.3, 0.0, 0.03}), truth(0.0, 0.3));
  EXPECT_NEAR(score.velocity_rms_m_s(), 0.03 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(score.worst_velocity_m_s(), 0.03, 1e-12);
  EXPECT_NEAR(score.velocity_nees(), 4.5, 1e-9);
}

TEST(OdometryScore, AHeadingThatIsOffIsNoErrorOfTheTrunksSpeedButOfTheWorlds) {
  OdometryScore score;
  score.add(said({}), truth(0.0));
  BodyState estimated = said({}, {0.3, 0.0, 0.0});
  estimated.estimated_quaternion_wxyz = {std::cos(0.05), 0.0, 0.0, std::sin(0.05)};
  score.add(estimated, truth(0.0, 0.3));
  EXPECT_NEAR(score.worst_velocity_m_s(), 0.0, 1e-12);
  EXPECT_GT(score.velocity_nees(), 1.0);
}

TEST(OdometryScore, TiltAndHeadingAreToldApart) {
  OdometryScore score;
  BodyState estimated = said({});
  score.add(estimated, truth(0.0));
  estimated.estimated_quaternion_wxyz = {std::cos(0.01), std::sin(0.01), 0.0, 0.0};
  score.add(estimated, truth(0.0));
  EXPECT_NEAR(score.worst_tilt_rad(), 0.02, 1e-5);
  EXPECT_NEAR(score.heading_error_rad(), 0.0, 1e-9);
  estimated.estimated_quaternion_wxyz = {std::cos(0.01), 0.0, 0.0, std::sin(0.01)};
  score.add(estimated, truth(0.0));
  EXPECT_NEAR(score.heading_error_rad(), 0.02, 1e-5);
}

TEST(OdometryScore, NothingIsMadeUpWhereNothingWasSaid) {
  const OdometryScore score;
  EXPECT_TRUE(std::isnan(score.velocity_rms_m_s()));
  EXPECT_TRUE(std::isnan(score.velocity_nees()));
}

}  // namespace
}  // namespace sprung
