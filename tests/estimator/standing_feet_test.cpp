#include "estimator/standing_feet.h"

#include <gtest/gtest.h>

#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

using test::TrunkPose;
using test::TrunkSample;

class StandingFeetTest : public testing::Test {
 protected:
  /// Long enough for every foot that stands to count fully.
  const StandingFeet& settle(double t = 0.0) {
    for (int k = 0; k < 50; ++k) feet_.update(trunk_.legs(t), trunk_.link_rates_rad_s(t), 0.002);
    return feet_;
  }
  static TrunkPose pose(double t) {
    return {{0.3 * t, 0.1 * t, 0.4 + 0.2 * t}, test::rpy(0.04 + 0.5 * t, -0.06 + 0.3 * t, 0.2 - 0.4 * t)};
  }
  TrunkSample trunk_{pose};
  StandingFeet feet_{trunk_.robot.legs};
};

TEST_F(StandingFeetTest, AFootWhoseLinkTurnsNobodyKnowsHowDoesNotStand) {
  settle();
  std::vector<Eigen::Vector3d> rates_rad_s = trunk_.link_rates_rad_s(0.0);
  rates_rad_s[1].y() = kNaN;
  feet_.update(trunk_.legs(0.0), rates_rad_s, 0.002);
  EXPECT_EQ(feet_.feet()[1].weight, 0.0);
  EXPECT_EQ(feet_.count(), 3);
}

TEST_F(StandingFeetTest, FootGainsItsWeightAfterTouchdownAndLosesItAtOnce) {
  feet_.update(trunk_.legs(0), trunk_.link_rates_rad_s(0), 0.002);
  const double first = feet_.feet()[0].weight;
  EXPECT_GT(first, 0.0);
  EXPECT_LT(first, 0.1);
  EXPECT_EQ(feet_.count(), 0);
  settle();
  EXPECT_DOUBLE_EQ(feet_.feet()[0].weight, 1.0);
  EXPECT_EQ(feet_.count(), 4);
  trunk_.stands[0] = false;
  feet_.update(trunk_.legs(0), trunk_.link_rates_rad_s(0), 0.002);
  EXPECT_EQ(feet_.feet()[0].weight, 0.0);
  EXPECT_EQ(feet_.count(), 3);
}

TEST_F(StandingFeetTest, FootThatHardlyCarriesHardlyCounts) {
  settle();
  std::vector<EstimatedLeg> legs = trunk_.legs(0);
  legs[0].foot_force_N[2] = 4.0;
  legs[1].contact_confidence = 0.5;
  feet_.update(legs, trunk_.link_rates_rad_s(0.0), 0.002);
  EXPECT_NEAR(feet_.feet()[0].weight, 0.1, 1e-12);
  EXPECT_NEAR(feet_.feet()[1].weight, 0.5, 1e-12);
}

TEST_F(StandingFeetTest, FootThatIsNotKnownDoesNotStand) {
  settle();
  std::vector<EstimatedLeg> legs = trunk_.legs(0);
  legs[0].estimated_foot_in_hip_m[1] = kNaN;
  legs[1].estimated_foot_velocity_m_s[0] = kNaN;
  legs[2].foot_force_N[2] = kNaN;
  feet_.update(legs, trunk_.link_rates_rad_s(0.0), 0.002);
  EXPECT_EQ(feet_.count(), 1);
  EXPECT_TRUE(feet_.angular_velocity_rad_s().allFinite());
  EXPECT_TRUE(feet_.tilt_error_rad(Eigen::Quaterniond::Identity()).allFinite());
}

TEST_F(StandingFeetTest, FourFeetShowEveryAngularVelocity) {
  settle();
  EXPECT_NEAR((feet_.angular_velocity_rad_s() - trunk_.angular_velocity_rad_s(0)).norm(), 0.0, 0.01);
}

TEST_F(StandingFeetTest, TwoFeetShowAllButTurningAboutTheirLine) {
  trunk_.stands = {true, false, false, true};
  settle();
  const Eigen::Vector3d line = (trunk_.pose(0).to_world.conjugate() *
                                (trunk_.feet_in_world_m[0] - trunk_.feet_in_world_m[3]))
                                   .normalized();
  const Eigen::Vector3d truth = trunk_.angular_velocity_rad_s(0);
  const Eigen::Vector3d shown = feet_.angular_velocity_rad_s();
  EXPECT_NEAR(shown.dot(line), 0.0, 1e-9);
  EXPECT_NEAR((shown - (truth - truth.dot(line) * line)).norm(), 0.0, 0.01);
}

TEST_F(StandingFeetTest, TiltErrorIsZeroAtTheTrueAttitudeAndUndoesAnyOther) {
  settle();
  const Eigen::Quaterniond truth = trunk_.pose(0).to_world;
  EXPECT_NEAR(feet_.tilt_error_rad(truth).norm(), 0.0, 1e-12);
  const Eigen::Quaterniond off = turned_by({0.02, -0.03, 0}) * truth;
  const Eigen::Vector3d error = feet_.tilt_error_rad(off);
  EXPECT_NEAR(error.x(), -0.02, 1e-3);
  EXPECT_NEAR(error.y(), 0.03, 1e-3);
  EXPECT_EQ(error.z(), 0.0);
}

TEST_F(StandingFeetTest, OneFootOrNoneShowNoTilt) {
  trunk_.stands = {true, false, false, false};
  settle();
  EXPECT_EQ(feet_.tilt_error_rad(Eigen::Quaterniond::Identity()).norm(), 0.0);
  trunk_.stands = {false, false, false, false};
  settle();
  EXPECT_EQ(feet_.angular_velocity_rad_s().norm(), 0.0);
  EXPECT_TRUE(std::isnan(feet_.height_m(Eigen::Quaterniond::Identity())));
}

TEST_F(StandingFeetTest, HeightIsThatOfTheTrunkOverTheMeanFoot) {
  trunk_.feet_in_world_m[0].z() = 0.02;
  settle();
  EXPECT_NEAR(feet_.height_m(trunk_.pose(0).to_world), 0.4 - 0.005, 1e-12);
}

TEST_F(StandingFeetTest, ResetForgetsWhatStood) {
  settle();
  feet_.reset();
  EXPECT_EQ(feet_.weight(), 0.0);
  EXPECT_EQ(feet_.count(), 0);
}

}  // namespace
}  // namespace sprung
