#include "planner/height_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

TEST(HeightLaw, AmplitudeAndHeightUndoEachOther) {
  EXPECT_NEAR(height_share(1.0), 1.0, 1e-12);
  for (double s = kLeastAmplitude; s < 2.0; s += 0.05) EXPECT_NEAR(amplitude_for(height_share(s)), s, 1e-9);
}

TEST(HeightLaw, HigherNeedsMoreAndTooLowGetsTheLeast) {
  for (double share = 0.5; share < 2.0; share += 0.1)
    EXPECT_GT(amplitude_for(share + 0.1), amplitude_for(share));
  EXPECT_EQ(amplitude_for(0.0), kLeastAmplitude);
  EXPECT_EQ(amplitude_for(-1.0), kLeastAmplitude);
}

TEST(HeightAdaptation, NextJumpIsAskedForWhatTheLastOneLacked) {
  HeightAdaptation adaptation(true);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), 1.0);
  adaptation.learn(JumpMode::kHybrid, 0.15, 0.12);
  EXPECT_NEAR(adaptation.factor(JumpMode::kHybrid), 1.25, 1e-12);
  adaptation.learn(JumpMode::kHybrid, 0.15, 0.15);
  EXPECT_NEAR(adaptation.factor(JumpMode::kHybrid), 1.25, 1e-12);
}

TEST(HeightAdaptation, ModesLearnApart) {
  HeightAdaptation adaptation(true);
  adaptation.learn(JumpMode::kTorque, 0.15, 0.10);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), 1.0);
  EXPECT_NEAR(adaptation.factor(JumpMode::kTorque), 1.5, 1e-12);
}

TEST(HeightAdaptation, ConvergesOnGroundThatTakesAThird) {
  HeightAdaptation adaptation(true);
  double reached = 0.0;
  for (int jump = 0; jump < 3; ++jump) {
    reached = 0.15 * adaptation.factor(JumpMode::kHybrid) * 0.67;
    adaptation.learn(JumpMode::kHybrid, 0.15, reached);
  }
  EXPECT_NEAR(reached, 0.15, 1e-9);
}

TEST(HeightAdaptation, IsBoundedAndIgnoresWhatCannotBe) {
  HeightAdaptation adaptation(true);
  adaptation.learn(JumpMode::kHybrid, 0.15, 0.001);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), kMostChange);
  adaptation.learn(JumpMode::kHybrid, 0.15, 0.001);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), kMostFactor);
  for (int k = 0; k < 5; ++k) adaptation.learn(JumpMode::kHybrid, 0.15, 9.0);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), kLeastFactor);
  adaptation.learn(JumpMode::kHybrid, 0.0, 0.1);
  adaptation.learn(JumpMode::kHybrid, 0.1, std::nan(""));
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), kLeastFactor);
}

TEST(HeightAdaptation, PresetThatDoesNotLearnStaysAsItIs) {
  HeightAdaptation adaptation(false);
  adaptation.learn(JumpMode::kHybrid, 0.15, 0.05);
  EXPECT_EQ(adaptation.factor(JumpMode::kHybrid), 1.0);
}

}  // namespace
}  // namespace sprung
