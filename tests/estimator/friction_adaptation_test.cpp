#include "estimator/friction_adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "signals/vec3.h"

namespace sprung {
namespace {

constexpr double kAdaptationUncertainty = 0.3;

/// A joint whose friction is `truth` of the law swings for that long, 5 ms by 5 ms.
void adaptation_swings(FrictionAdaptation& adaptation, const FrictionFactors& truth, double seconds,
                       double other_std_Nm = 1.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.3);
  for (double t = 0.0; t < seconds; t += 0.005) {
    const double w = 2.0 * std::sin(6.0 * t);
    const FrictionByLaw law{std::copysign(8.0, w), 5.0 * w};
    const double excess_Nm = law.torque_Nm(truth) - law.torque_Nm(adaptation.factors()) + noise(random);
    adaptation.age(0.005);
    adaptation.learn({law, excess_Nm, other_std_Nm, 0.005});
  }
}

TEST(FrictionAdaptationTest, KnowsAtFirstWhatRobotYamlStates) {
  const FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  EXPECT_EQ(adaptation.factors().dry, 1.0);
  EXPECT_EQ(adaptation.factors().viscous, 1.0);
  EXPECT_NEAR(adaptation.std_Nm({10.0, 0.0}), 3.0, 1e-12);
  EXPECT_LE(adaptation.std_Nm({10.0, 5.0}), 4.5);
  EXPECT_GT(adaptation.std_Nm({10.0, 5.0}), 3.8);
}

TEST(FrictionAdaptationTest, FindsADryPartThatIsMoreAndAViscousThatIsLess) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  adaptation_swings(adaptation, {1.2, 0.6}, 60.0);
  EXPECT_NEAR(adaptation.factors().dry, 1.2, 0.06);
  EXPECT_NEAR(adaptation.factors().viscous, 0.6, 0.08);
}

TEST(FrictionAdaptationTest, BoundsShrinkByMotionButKeepWhatNoFactorLearns) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  const double before_Nm = adaptation.std_Nm({10.0, 5.0});
  adaptation_swings(adaptation, {}, 60.0);
  EXPECT_LT(adaptation.std_Nm({10.0, 5.0}), 0.6 * before_Nm);
  EXPECT_GT(adaptation.std_Nm({10.0, 5.0}), 0.4 * 0.3 * 14.0);
}

TEST(FrictionAdaptationTest, OneSwingMovesItLittle) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  adaptation_swings(adaptation, {1.3, 1.3}, 0.15, 4.0);
  EXPECT_GT(adaptation.factors().dry, 1.0);
  EXPECT_LT(adaptation.factors().dry, 1.15);
}

TEST(FrictionAdaptationTest, GoesNoFurtherThanTwiceTheStatedUncertainty) {
  FrictionAdaptation adaptation(0.1, true);
  for (int k = 0; k < 20; ++k) adaptation_swings(adaptation, {1.0 + 0.05 * k, 1.0}, 10.0);
  EXPECT_LE(adaptation.factors().dry, 1.2);
  EXPECT_GE(adaptation.factors().viscous, 0.8);
}

TEST(FrictionAdaptationTest, WhatIsFarBeyondWhatFrictionMayBeTeachesNothing) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  adaptation.learn({{8.0, 5.0}, 60.0, 1.0, 0.005});
  EXPECT_EQ(adaptation.factors().dry, 1.0);
  EXPECT_EQ(adaptation.factors().viscous, 1.0);
}

TEST(FrictionAdaptationTest, ASwingInWhichSomethingMovedTheJointTeachesNothingToItsEnd) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  SeenFriction moved{{8.0, 5.0}, -60.0, 1.0, 0.005, false};
  adaptation.learn(moved);
  for (int k = 0; k < 50; ++k) adaptation.learn({{8.0, 5.0}, -2.0, 1.0, 0.005});
  EXPECT_EQ(adaptation.factors().dry, 1.0);
  for (int k = 0; k < 50; ++k) adaptation.learn({{8.0, 5.0}, -2.0, 1.0, 0.005});
  EXPECT_LT(adaptation.factors().dry, 1.0);
}

TEST(FrictionAdaptationTest, FrictionIsNotSeenWhereTheMotorBrakes) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  for (int k = 0; k < 50; ++k) adaptation.learn({{8.0, 5.0}, -2.0, 1.0, 0.005, false});
  EXPECT_EQ(adaptation.factors().dry, 1.0);
}

TEST(FrictionAdaptationTest, ForgetsAsAGearCools) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  adaptation_swings(adaptation, {1.0, 0.6}, 60.0);
  const double warm = adaptation.factors().viscous;
  for (int k = 0; k < 1200; ++k) adaptation.age(1.0);
  EXPECT_GT(adaptation.factors().viscous, 1.0 - 0.2 * (1.0 - warm));
  EXPECT_NEAR(adaptation.std_Nm({10.0, 0.0}), 3.0, 0.1);
}

TEST(FrictionAdaptationTest, SwitchedOffItStatesWhatRobotYamlStates) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, false);
  adaptation_swings(adaptation, {1.3, 0.6}, 60.0);
  EXPECT_EQ(adaptation.factors().dry, 1.0);
  EXPECT_DOUBLE_EQ(adaptation.std_Nm({10.0, 5.0}), 4.5);
}

TEST(FrictionAdaptationTest, NumbersThatAreNoneTeachNothing) {
  FrictionAdaptation adaptation(kAdaptationUncertainty, true);
  adaptation.learn({{8.0, 5.0}, kNaN, 1.0, 0.005});
  adaptation.learn({{8.0, kNaN}, 1.0, 1.0, 0.005});
  adaptation.learn({{8.0, 5.0}, 1.0, kNaN, 0.005});
  adaptation.learn({{8.0, 5.0}, 1.0, 1.0, 0.0});
  EXPECT_EQ(adaptation.factors().dry, 1.0);
  EXPECT_NEAR(adaptation.std_Nm({10.0, 0.0}), 3.0, 1e-12);
}

}  // namespace
}  // namespace sprung
