#include "tools/lab/estimation/contact_scorer.h"

#include <gtest/gtest.h>

#include "tests/support/enumerators.h"

namespace sprung {
namespace {

class ContactScorerTest : public testing::Test {
 protected:
  /// Milliseconds with this true force and this report, the foot sinking at `speed_m_s`.
  void go(int milliseconds, double force_N, bool reported, double speed_m_s = 0.0) {
    for (int i = 0; i < milliseconds; ++i) {
      truth_.stamp.utime_us += 1000;
      truth_.legs[0].true_contact_force_N[2] = force_N;
      truth_.legs[0].true_foot_in_world_m[2] -= 1e-3 * speed_m_s;
      estimate_.legs[0].contact = reported;
      scorer_.add(estimate_, truth_);
    }
  }
  void stand_and_lift(int late_ms) {
    go(20, 50.0, true);
    scorer_.begin_step();
    go(30, 50.0, true);
    go(late_ms, 0.0, true);
  }

  ContactScorer scorer_{0};
  JointState estimate_{2, 1};
  SimTruth truth_{2, 1};
};

TEST(ApproachClassTest, EveryOneHasItsOwnName) { test::expect_own_names<ApproachClass>(); }

TEST(ApproachClassTest, IsByTheIssuesSpeeds) {
  EXPECT_EQ(approach_class(1.2), ApproachClass::kFast);
  EXPECT_EQ(approach_class(1.0), ApproachClass::kMedium);
  EXPECT_EQ(approach_class(0.3), ApproachClass::kSlow);
}

TEST_F(ContactScorerTest, DelayIsFromTheFirstForceToTheReport) {
  stand_and_lift(4);
  go(200, 0.0, false, 0.7);
  go(6, 10.0, false);
  go(50, 80.0, true);
  const auto& steps = scorer_.finish();
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(*steps[0].approach_speed_m_s, 0.7, 1e-9);
  EXPECT_DOUBLE_EQ(*steps[0].delay_ms, 6.0);
  EXPECT_DOUBLE_EQ(*steps[0].lift_off_delay_ms, 4.0);
  EXPECT_FALSE(steps[0].false_alarm);
}

TEST_F(ContactScorerTest, ReportInTheCycleOfTheFirstForceIsNotLate) {
  scorer_.begin_step();
  go(100, 0.0, false);
  go(10, 10.0, true);
  EXPECT_DOUBLE_EQ(*scorer_.finish().at(0).delay_ms, 0.0);
}

TEST_F(ContactScorerTest, ContactReportedBeforeTouchdownIsAFalseAlarmAndNotFound) {
  scorer_.begin_step();
  go(100, 0.0, false);
  go(10, 0.0, true);
  go(50, 10.0, true);
  const auto& steps = scorer_.finish();
  EXPECT_TRUE(steps.at(0).false_alarm);
  EXPECT_FALSE(steps.at(0).delay_ms);
}

TEST_F(ContactScorerTest, ShortReportWithoutAFloorIsAFalseAlarm) {
  scorer_.begin_step();
  go(100, 0.0, false);
  go(1, 0.0, true);
  go(100, 0.0, false);
  EXPECT_TRUE(scorer_.finish().at(0).false_alarm);
  EXPECT_FALSE(scorer_.finish().at(0).approach_speed_m_s);
}

TEST_F(ContactScorerTest, ReportThatOutlivesTheContactIsAFalseAlarmOnlyWhenItDoesNotEnd) {
  stand_and_lift(45);
  go(100, 0.0, false);
  scorer_.begin_step();
  go(60, 50.0, true);
  go(70, 0.0, true);
  const auto& steps = scorer_.finish();
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_FALSE(steps[0].false_alarm);
  EXPECT_TRUE(steps[1].false_alarm);
}

TEST_F(ContactScorerTest, RiseJustAfterLiftOffIsAFalseAlarm) {
  stand_and_lift(2);
  go(5, 0.0, false);
  go(5, 0.0, true);
  go(100, 0.0, false);
  EXPECT_TRUE(scorer_.finish().at(0).false_alarm);
}

TEST_F(ContactScorerTest, BounceIsNoSwing) {
  stand_and_lift(2);
  go(ContactScorer::kFree_us / 1000 - 10, 0.0, false);
  go(20, 10.0, false);
  EXPECT_TRUE(scorer_.finish().empty());
}

TEST_F(ContactScorerTest, WhatIsReportedMuchLaterIsNotFound) {
  scorer_.begin_step();
  go(100, 0.0, false);
  go(ContactScorer::kLatest_us / 1000 + 5, 10.0, false);
  go(10, 10.0, true);
  EXPECT_FALSE(scorer_.finish().at(0).delay_ms);
}

}  // namespace
}  // namespace sprung
