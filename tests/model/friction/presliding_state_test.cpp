#include "model/friction/presliding_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/friction/friction_law.h"

namespace sprung {
namespace {

constexpr double kAngle_rad = 7e-4;

TEST(PreslidingStateTest, StartsWithTheStatedStiffness) {
  PreslidingState state(kAngle_rad);
  state.reset(1.0);
  EXPECT_NEAR(state.step(1.0 + 0.1 * kAngle_rad), 0.1, 1e-9);
  EXPECT_FALSE(state.known());
}

TEST(PreslidingStateTest, SlidesAfterItsLongestElementHasSlipped) {
  PreslidingState state(kAngle_rad);
  state.reset(0.0);
  EXPECT_LT(state.step(3.7 * kAngle_rad), 1.0);
  EXPECT_FALSE(state.known());
  EXPECT_EQ(state.step(3.8 * kAngle_rad), 1.0);
  EXPECT_TRUE(state.known());
  EXPECT_EQ(state.step(1.0), 1.0);
  EXPECT_NEAR(state.sign_by_presliding_1_rad(), 0.0, 1e-9);  // rounding of 1 / 7e-4
}

TEST(PreslidingStateTest, NeverLeavesMinusOneToOne) {
  PreslidingState state(kAngle_rad);
  for (int i = 0; i < 10000; ++i) {
    const double sign = state.step(0.002 * std::sin(0.05 * i) + 0.001 * std::sin(0.31 * i));
    ASSERT_LE(std::abs(sign), 1.0);
  }
}

TEST(PreslidingStateTest, ReversalFollowsMasingsRule) {
  // After sliding one way the branch back is the first branch, twice as wide and twice as high.
  PreslidingState first(kAngle_rad), back(kAngle_rad);
  first.reset(0.0);
  back.reset(0.0, 1.0);
  for (double share = 0.1; share < 4.0; share += 0.1) {
    const double virgin = first.step(share * kAngle_rad);
    EXPECT_NEAR(back.step(-2.0 * share * kAngle_rad), 1.0 - 2.0 * virgin, 1e-12);
  }
}

TEST(PreslidingStateTest, ReturnsExactlyAfterAMillionDithers) {
  PreslidingState state(kAngle_rad);
  state.reset(0.3);
  const double loaded = state.step(0.3 + 0.3 * kAngle_rad);
  for (int i = 0; i < 1000000; ++i) {
    state.step(0.3 + (0.3 + 0.1 * std::sin(0.1 * i)) * kAngle_rad);
  }
  EXPECT_EQ(state.step(0.3 + 0.3 * kAngle_rad), loaded);
}

TEST(PreslidingStateTest, DependsOnThePathAndNotOnItsSteps) {
  PreslidingState coarse(kAngle_rad), fine(kAngle_rad);
  coarse.reset(0.0);
  fine.reset(0.0);
  for (const double target : {2.0, -0.7, 1.1, 0.2}) {
    const double from = target == 2.0 ? 0.0 : target == -0.7 ? 2.0 : target == 1.1 ? -0.7 : 1.1;
    for (int i = 1; i <= 1000; ++i) fine.step((from + 0.001 * i * (target - from)) * kAngle_rad);
    coarse.step(target * kAngle_rad);
    EXPECT_NEAR(fine.sign(), coarse.sign(), 1e-9);
  }
}

TEST(PreslidingStateTest, TakesEnergyOverEveryLoop) {
  PreslidingState state(kAngle_rad);
  double work = 0.0, before_rad = 0.0;
  state.reset(0.0);
  for (int i = 1; i <= 20000; ++i) {
    const double position_rad = 2.0 * kAngle_rad * std::sin(0.001 * 3.14159265358979 * i);
    const double mean = 0.5 * state.sign();
    work += (mean + 0.5 * state.step(position_rad)) * (position_rad - before_rad);
    before_rad = position_rad;
  }
  EXPECT_GT(work, 0.0);
}

TEST(PreslidingStateTest, TwoBeginningsBracketAllOthersAndMeet) {
  PreslidingState low(kAngle_rad), high(kAngle_rad), middle(kAngle_rad);
  low.reset(0.0, -1.0);
  high.reset(0.0, 1.0);
  middle.reset(0.0, 0.3);
  for (int i = 1; i <= 100; ++i) {
    const double position_rad = 0.08 * i * kAngle_rad;
    EXPECT_LE(low.step(position_rad), middle.step(position_rad));
    EXPECT_LE(middle.sign(), high.step(position_rad));
  }
  EXPECT_TRUE(low.known());
  EXPECT_EQ(low.sign(), high.sign());
}

TEST(PreslidingStateTest, SensitivityIsThatOfFiniteDifferences) {
  const double step_rad = 1e-6 * kAngle_rad;
  PreslidingState here(kAngle_rad), above(kAngle_rad + step_rad), below(kAngle_rad - step_rad);
  for (PreslidingState* state : {&here, &above, &below}) state->reset(0.0);
  for (int i = 0; i < 400; ++i) {
    const double position_rad = kAngle_rad * (1.9 * std::sin(0.071 * i) + 0.8 * std::sin(0.19 * i));
    for (PreslidingState* state : {&here, &above, &below}) state->step(position_rad);
    const double difference = (above.sign() - below.sign()) / (2.0 * step_rad);
    ASSERT_NEAR(here.sign_by_presliding_1_rad() * kAngle_rad, difference * kAngle_rad, 1e-6) << i;
  }
}

TEST(PreslidingStateTest, RigidGivesTheSignOfTheLastMovement) {
  PreslidingState state;
  EXPECT_EQ(state.step(0.5), 0.0);
  EXPECT_FALSE(state.known());
  EXPECT_EQ(state.step(0.6), 1.0);
  EXPECT_EQ(state.step(0.6), 1.0);
  EXPECT_EQ(state.step(0.59), -1.0);
  EXPECT_TRUE(state.known());
}

TEST(PreslidingStateTest, StifferElementsApproachTheSign) {
  double before = 2.0;
  for (const double angle_rad : {1e-2, 1e-3, 1e-4, 1e-5}) {
    PreslidingState state(angle_rad);
    state.reset(0.0);
    const double gap = 1.0 - state.step(2e-4);
    EXPECT_LT(gap, before);
    before = gap;
  }
  EXPECT_EQ(before, 0.0);
}

}  // namespace
}  // namespace sprung
