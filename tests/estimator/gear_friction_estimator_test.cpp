#include "estimator/gear_friction_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sprung {
namespace {

constexpr double kGearFrictionEstimatorDt_s = 0.001;
constexpr double kCoulomb_Nm = 7.0;
constexpr double kCount_rad = 4.8e-7;

JointConfig joint(double load_share = 0.0, double presliding_rad = 0.0) {
  JointConfig j;
  j.armature_kg_m2 = 0.8;
  IdentifiedFriction friction;
  friction.parameters.coulomb_Nm = kCoulomb_Nm;
  friction.parameters.load_share_driving = friction.parameters.load_share_driven = load_share;
  friction.parameters.presliding_rad = presliding_rad;
  j.friction = friction;
  return j;
}

GearFrictionEstimator::Motion motion(double velocity_rad_s, double motor_Nm, double tracked_Nm = 0.0,
                                     double position_rad = 0.0) {
  GearFrictionEstimator::Motion m;
  m.measured_position_rad = position_rad;
  m.velocity_rad_s = velocity_rad_s;
  m.motor_torque_Nm = motor_Nm;
  m.tracked_output_Nm = tracked_Nm;
  m.dt_s = kGearFrictionEstimatorDt_s;
  return m;
}

void rest(GearFrictionEstimator& gear, double motor_Nm, int cycles = 200) {
  for (int k = 0; k < cycles; ++k) gear.update(motion(0.0, motor_Nm));
}

TEST(GearFrictionEstimatorTest, MovingItIsTheLawAndTheFiltersLoad) {
  GearFrictionEstimator gear(joint(0.1));
  gear.start(0.0, 0.0);
  gear.update(motion(-0.5, -20.0, -12.0));
  EXPECT_FALSE(gear.at_rest());
  EXPECT_EQ(gear.output_torque_Nm(), -12.0);
  EXPECT_NEAR(gear.friction_torque_Nm(), -(kCoulomb_Nm + 1.2), 1e-12);
  EXPECT_EQ(gear.rest_distance_Nm(), 0.0);
}

TEST(GearFrictionEstimatorTest, AtRestTheLastEstimateStaysWhileItIsPossible) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 0.0);
  gear.update(motion(0.5, 17.0, 10.0));
  rest(gear, 12.0);
  EXPECT_TRUE(gear.at_rest());
  EXPECT_EQ(gear.output_torque_Nm(), 10.0);
  EXPECT_NEAR(gear.friction_torque_Nm(), 2.0, 1e-12);
  EXPECT_NEAR(gear.rest_distance_Nm(), 9.0, 1e-3);  // of [5, 19]
}

/// A knee that a motor of 171 Nm turns round in flight: for a cycle it is as slow as one at rest.
TEST(GearFrictionEstimatorTest, JointThatReversesIsNotAtRest) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 0.0);
  gear.update(motion(-0.5, 171.0, 0.1));
  GearFrictionEstimator::Motion reversal = motion(0.0, 171.0, 0.1);
  reversal.tracked_output_std_Nm = 5.0;
  gear.update(reversal);
  EXPECT_FALSE(gear.at_rest());
  EXPECT_EQ(gear.output_torque_Nm(), 0.1);
  reversal.motor_torque_Nm = 0.1 + kCoulomb_Nm + 4.0 * 5.0 - 0.1;  // may be noise
  gear.update(reversal);
  EXPECT_TRUE(gear.at_rest());
}

TEST(GearFrictionEstimatorTest, AtRestTheEstimateMovesOnlyAsFarAsItMust) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 10.0);
  rest(gear, 30.0);
  EXPECT_NEAR(gear.output_torque_Nm(), 30.0 - kCoulomb_Nm, 1e-6);
  EXPECT_NEAR(gear.rest_distance_Nm(), 2.0 * kCoulomb_Nm, 1e-6);
  rest(gear, 10.0);
  EXPECT_NEAR(gear.output_torque_Nm(), 10.0 + kCoulomb_Nm, 1e-6);
}

TEST(GearFrictionEstimatorTest, LoadDependentFrictionWidensWhatIsPossible) {
  GearFrictionEstimator gear(joint(0.2));
  gear.start(0.0, 60.0);
  rest(gear, 60.0);
  // Driving: (60 - 7) / 1.2; held back: (60 + 7) / 0.8.
  EXPECT_NEAR(gear.rest_distance_Nm(), std::max(60.0 - 53.0 / 1.2, 67.0 / 0.8 - 60.0), 1e-3);
}

/// Set membership against a gear that truly sticks: whatever the load does, it stays within the stated
/// distance.
TEST(GearFrictionEstimatorTest, AnyLoadThatTheGearHoldsIsWithinTheDistance) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 0.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double motor_Nm = 40.0 * even(random);
    const double load_Nm = motor_Nm + kCoulomb_Nm * even(random);
    rest(gear, motor_Nm);
    EXPECT_LE(std::abs(gear.output_torque_Nm() - load_Nm), gear.rest_distance_Nm() + 1e-3);
  }
}

TEST(GearFrictionEstimatorTest, EncoderNoiseMakesNeitherMotionNorChatter) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 20.0);
  rest(gear, 20.0);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> counts(-1, 1);
  std::normal_distribution<double> velocity(0.0, 0.001), torque(0.0, 0.5);
  for (int k = 0; k < 5000; ++k) {
    GearFrictionEstimator::Motion m = motion(velocity(random), 20.0 + torque(random), 25.0 * velocity(random),
                                             kCount_rad * counts(random));
    gear.update(m);
    ASSERT_TRUE(gear.at_rest());
    ASSERT_NEAR(gear.output_torque_Nm(), 20.0, 1e-9);
  }
}

TEST(GearFrictionEstimatorTest, ANoisyFilterIsGivenMoreRoom) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 0.0);
  GearFrictionEstimator::Motion m = motion(0.05, 10.0, 3.0);
  m.velocity_std_rad_s = 0.02;
  gear.update(m);
  EXPECT_TRUE(gear.at_rest());
  m.velocity_std_rad_s = 0.002;
  gear.update(m);
  EXPECT_FALSE(gear.at_rest());
}

TEST(GearFrictionEstimatorTest, FrictionAheadHoldsAStuckJointAndBreaksAwayAtItsLimit) {
  GearFrictionEstimator gear(joint());
  gear.start(0.0, 10.0);
  rest(gear, 10.0);
  EXPECT_NEAR(gear.ahead_Nm(14.0), 4.0, 1e-12);  // load 10: the gear takes the rest
  EXPECT_NEAR(gear.ahead_Nm(50.0), kCoulomb_Nm, 1e-12);
  EXPECT_NEAR(gear.ahead_Nm(-50.0), -kCoulomb_Nm, 1e-12);
}

TEST(GearFrictionEstimatorTest, SignReturnsOverThePreslidingDistance) {
  constexpr double kPresliding_rad = 5e-4;
  GearFrictionEstimator gear(joint(0.0, kPresliding_rad));
  gear.start(0.0, 0.0);
  double before_Nm = 0.0;
  for (int k = 1; k <= 200; ++k) {
    gear.update(motion(0.1, 10.0, 3.0, 2e-5 * k));
    EXPECT_GE(gear.friction_torque_Nm(), before_Nm);
    EXPECT_LT(gear.friction_torque_Nm() - before_Nm, 0.05 * kCoulomb_Nm);
    before_Nm = gear.friction_torque_Nm();
  }
  EXPECT_NEAR(before_Nm, kCoulomb_Nm, 1e-9);
}

}  // namespace
}  // namespace sprung
