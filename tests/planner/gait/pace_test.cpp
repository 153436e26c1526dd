#include "planner/gait/pace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/gait_speed.h"

namespace sprung {
namespace {

constexpr double kPaceStep_s = 0.002;
GaitConfig crawling_gait() {
  GaitConfig gait;
  gait.fastest_forward_m_s = gait.fastest_backward_m_s = 0.12;
  gait.fastest_sideways_m_s = 0.06;
  gait.fastest_turning_rad_s = 0.15;
  return gait;
}

class PaceTest : public testing::Test {
 protected:
  void run(double duration_s, bool waits) {
    for (int k = 0; k < duration_s / kPaceStep_s - 0.5; ++k) {
      pace_.advance(waits, wanted_, gait_, kPaceStep_s);
      gone_m_ += pace_.now() * pace_.speed()[0] * kPaceStep_s;
      wanted_m_ += wanted_[0] * kPaceStep_s;
    }
  }
  Pace pace_;
  const GaitConfig gait_ = crawling_gait();
  Pace::Speed wanted_{0.1, 0.0, 0.0};
  double gone_m_ = 0.0;
  double wanted_m_ = 0.0;
};

TEST_F(PaceTest, GoesAtTheWantedSpeedWhereNothingIsLost) {
  run(5.0, false);
  EXPECT_EQ(pace_.now(), 1.0);
  EXPECT_EQ(pace_.speed(), wanted_);
}

TEST_F(PaceTest, TheBodyStopsWithTheClockWithoutAJerk) {
  run(0.1, true);
  EXPECT_NEAR(pace_.now(), 0.5, 1e-9);
  run(0.1, true);
  EXPECT_NEAR(pace_.now(), 0.0, 1e-9);
  run(1.0, true);
  EXPECT_EQ(pace_.now(), 0.0);
  run(0.1, false);
  EXPECT_NEAR(pace_.now(), 0.5, 1e-9);
}

TEST_F(PaceTest, KeepsTheMeanSpeedOfAWalkThatWaitsNowAndThen) {
  for (int k = 0; k < 60; ++k) {
    run(0.05, true);
    run(0.95, false);
  }
  EXPECT_NEAR(gone_m_, wanted_m_, 0.04);  // what was lost last is still to come
  EXPECT_GT(pace_.speed()[0], wanted_[0]);
}

TEST_F(PaceTest, CatchesUpWithWhatSprungLegsLagBy) {
  run(1.0, false);
  pace_.lose(0.02, 0.0);
  run(30.0, false);
  EXPECT_NEAR(gone_m_ - wanted_m_, 0.02, 1e-4);
  EXPECT_NEAR(pace_.speed()[0], wanted_[0], 1e-4);
}

TEST_F(PaceTest, SlowsDownAfterGoingTooFar) {
  run(1.0, false);
  pace_.lose(-0.02, 0.0);
  run(1.0, false);
  EXPECT_LT(pace_.speed()[0], wanted_[0]);
  run(30.0, false);
  EXPECT_NEAR(gone_m_ - wanted_m_, -0.02, 1e-4);
}

TEST_F(PaceTest, GoesAtMostAFifthFasterOrSlower) {
  wanted_ = {0.05, 0.0, 0.0};
  run(30.0, true);
  EXPECT_NEAR(pace_.speed()[0], (1.0 + Pace::kMost) * 0.05, 1e-12);
  pace_.lose(-9.0, 0.0);
  run(2 * kPaceStep_s, true);
  EXPECT_NEAR(pace_.speed()[0], (1.0 - Pace::kMost) * 0.05, 1e-12);
}

TEST_F(PaceTest, DoesNotGoFasterThanTheGaitMay) {
  wanted_ = {-0.11, 0.0, 0.0};
  run(30.0, true);
  EXPECT_NEAR(pace_.speed()[0], -0.12, 1e-9);  // but for rounding
}

TEST_F(PaceTest, DoesNotGoFasterInAllDirectionsTogetherThanTheGaitMay) {
  const double share = 0.95 / speed_share(gait_, {0.12, 0.06, 0.15});
  wanted_ = {0.12 * share, -0.06 * share, 0.15 * share};
  run(30.0, true);
  EXPECT_NEAR(speed_share(gait_, pace_.speed()), 1.0, 1e-9);
  EXPECT_NEAR(pace_.speed()[1] / pace_.speed()[0], -0.5, 1e-9);
}

TEST_F(PaceTest,
       WhatIsWantedStaysEvenBeyondWhatTheGaitMay) {  // a change to a slower gait, while the ramp still comes
                                                     // down
  wanted_ = {0.2, 0.0, 0.0};
  run(30.0, true);
  EXPECT_NEAR(pace_.speed()[0], 0.2, 1e-12);
}

TEST_F(PaceTest, AFootThatNobodyKnowsCountsForNothing) {
  pace_.lose(std::nan(""), 0.0);
  pace_.lose(0.0, std::nan(""));
  run(1.0, false);
  EXPECT_EQ(pace_.speed(), wanted_);
}

TEST_F(PaceTest, NothingIsCaughtUpWithWhereNobodyWantsToGo) {
  wanted_ = {};
  pace_.lose(0.05, 0.05);
  run(1.0, false);
  EXPECT_EQ(gone_m_, 0.0);
  wanted_ = {0.1, 0.0, 0.0};
  run(kPaceStep_s, false);
  EXPECT_EQ(pace_.speed(), wanted_);
}

TEST_F(PaceTest, ALongStopIsForgotten) {
  run(60.0, true);
  gone_m_ = wanted_m_ = 0.0;
  run(60.0, false);
  EXPECT_LT(gone_m_ - wanted_m_, 0.1 * 1.1);  // a second of walking
}

TEST_F(PaceTest, ForgetsWhenItBeginsAnew) {
  run(10.0, true);
  pace_.reset();
  EXPECT_EQ(pace_.now(), 1.0);
  run(kPaceStep_s, false);
  EXPECT_EQ(pace_.speed(), wanted_);
}

}  // namespace
}  // namespace sprung
