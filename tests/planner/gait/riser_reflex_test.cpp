#include "planner/gait/riser_reflex.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

class RiserReflexTest : public testing::Test {
 protected:
  /// A foot 54 mm over the ground that is wanted further along its way than it is. @return in how many of the
  /// cycles it was found to be held up.
  int lag(double behind_m, int cycles = 10) {
    int found = 0;
    for (int k = 0; k < cycles; ++k)
      found += riser_.step({way_m_, 0.0}, foot_m_ + Eigen::Vector3d(behind_m, 0.03, 0.02), foot_m_, 0.002);
    return found;
  }

  RiserReflex riser_;
  double way_m_ = 0.3;
  Eigen::Vector3d foot_m_{0.1, 0.2, -0.446};
};

TEST_F(RiserReflexTest, AFreeFootIsNotHeldUpHoweverLongItLags) {
  EXPECT_EQ(lag(0.01, 1000), 0);
  EXPECT_EQ(lag(-0.05), 0) << "it is ahead";
  EXPECT_FALSE(riser_.goes_over());
  EXPECT_EQ(riser_.foothold_m(foot_m_), foot_m_);
  EXPECT_EQ(riser_.aside_m(), Eigen::Vector2d::Zero());
}

TEST_F(RiserReflexTest, WhatStaysBehindForTenMillisecondsIsHeldUp) {
  EXPECT_EQ(lag(0.025, 4), 0);
  EXPECT_EQ(lag(0.01, 1), 0) << "it counts anew";
  EXPECT_EQ(lag(0.025, 4), 0);
  EXPECT_EQ(lag(0.025, 1), 1);
  EXPECT_TRUE(riser_.goes_over());
}

TEST_F(RiserReflexTest, AFootThatHardlyMovesCannotBe) {
  way_m_ = 0.02;
  EXPECT_EQ(lag(0.05, 100), 0);
}

TEST_F(RiserReflexTest, ThenItGoesBackOverAndBeyondTheEdge) {
  ASSERT_EQ(lag(0.025), 1);
  EXPECT_NEAR(riser_.top_m(-0.5), -0.446 + 0.07, 1e-12);
  EXPECT_NEAR(riser_.top_m(-0.9), -0.54, 1e-12) << "no leg folds further";
  EXPECT_LT(riser_.aside_m().x(), -0.02);
  EXPECT_NEAR(riser_.foothold_m({0.12, 0.2, -0.5}).x(), 0.1 + 0.12, 1e-12);
  EXPECT_EQ(riser_.foothold_m({0.3, 0.2, -0.5}).x(), 0.3) << "far enough already";
  EXPECT_NEAR(riser_.foothold_m({0.0, 0.2, -0.5}).x(), 0.1, 1e-12) << "no leg reaches further";
}

TEST_F(RiserReflexTest, WhereItWasHeldUpGoesAlongWithTheGround) {
  ASSERT_EQ(lag(0.025), 1);
  for (int k = 0; k < 100; ++k) riser_.carry({-0.1, 0.0, 0.0}, 0.002);
  EXPECT_NEAR(riser_.held_m().x(), 0.08, 1e-12);
  riser_.sink(0.03);
  EXPECT_NEAR(riser_.held_m().z(), -0.416, 1e-12);
}

TEST_F(RiserReflexTest, WhatItTouchesOnItsWayIsAnEdgeAndNoGround) {
  lag(0.005, 1);
  EXPECT_FALSE(riser_.on_edge());
  lag(0.015, 1);
  EXPECT_TRUE(riser_.on_edge());
  lag(0.005, 1);
  EXPECT_FALSE(riser_.on_edge());
}

TEST_F(RiserReflexTest, AQuickerSwingMayLagMoreAndThreeTimesIsEnough) {
  ASSERT_EQ(lag(0.025), 1);
  EXPECT_EQ(lag(0.025), 0);
  EXPECT_EQ(lag(0.035, 5), 1);
  EXPECT_EQ(lag(0.035, 5), 1);
  EXPECT_EQ(lag(0.035, 100), 0);
}

TEST_F(RiserReflexTest, TheNextSwingKnowsNothingOfIt) {
  ASSERT_EQ(lag(0.025), 1);
  riser_.forget();
  EXPECT_FALSE(riser_.goes_over());
}

}  // namespace
}  // namespace sprung
