#include "planner/fall_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tests/planner/gait/standing_robot.h"

namespace sprung {
namespace {

constexpr double kStands = -1.0;  // no gait
constexpr double kSwing_s = 0.4;

/// pegasus on level ground at rest, all feet loaded.
class FallDetectorTest : public testing::Test {
 protected:
  void tilt(double angle_rad, bool roll) {
    in_.body.estimated_quaternion_wxyz = {std::cos(0.5 * angle_rad), roll ? std::sin(0.5 * angle_rad) : 0.0,
                                          roll ? 0.0 : std::sin(0.5 * angle_rad), 0.0};
  }
  void hold(bool fl, bool fr, bool hl, bool hr) {
    const bool held[] = {fl, fr, hl, hr};
    for (std::size_t i = 0; i < 4; ++i) in_.legs[i].contact = held[i];
  }
  /// The last of the cycles.
  Fall after(double duration_s, double swing_s = kSwing_s) {
    Fall out = Fall::kNone;
    for (double t_s = 0.0; t_s < duration_s - 1e-9; t_s += 0.002) {
      in_.stamp.utime_us += 2000;
      out = falls_.step(in_, swing_s, along_);
    }
    return out;
  }

  RobotConfig robot_ = load_robot("pegasus");
  FallDetector falls_{robot_};
  JointState in_ = test::standing(robot_);
  Attitude along_;
};

TEST_F(FallDetectorTest, TiltBeyondTheLimitToAnySideIsAFall) {
  for (const bool roll : {true, false}) {
    for (const double sign : {-1.0, 1.0}) {
      tilt(sign * 0.69, roll);
      EXPECT_EQ(after(0.002), Fall::kNone);
      tilt(sign * 0.71, roll);
      EXPECT_EQ(after(0.002), Fall::kLies);
    }
  }
}

TEST_F(FallDetectorTest, HipsTooLowOverTheFeetAreAFall) {
  in_.body.estimated_height_m = 0.251;
  EXPECT_EQ(after(0.002), Fall::kNone);
  in_.body.estimated_height_m = 0.249;
  EXPECT_EQ(after(0.002), Fall::kLies);
}

TEST_F(FallDetectorTest, CapturePointFarBeyondTheFeetWillBeAFallAndAJumpOfTheVelocityIsNone) {
  tilt(-0.12, true);                                  // to its left
  in_.body.estimated_velocity_m_s = {0.0, 1.2, 0.0};  // 0.27 m ahead, 0.13 beyond the left feet
  EXPECT_EQ(after(0.5), Fall::kNone);
  in_.body.estimated_velocity_m_s = {0.0, 2.0, 0.0};  // 0.31 m beyond
  EXPECT_EQ(after(0.008), Fall::kNone);
  in_.body.estimated_velocity_m_s = {0.0, 0.0, 0.0};
  EXPECT_EQ(after(0.002), Fall::kNone);
  in_.body.estimated_velocity_m_s = {0.0, 2.0, 0.0};
  EXPECT_EQ(after(0.008), Fall::kNone) << "it counts anew";
  EXPECT_EQ(after(0.008), Fall::kFalls);
  EXPECT_EQ(falls_.found(), Fall::kFalls);
}

TEST_F(FallDetectorTest, WhoLiesAlongARampDoesNotTipAndWhoLiesLevelOnItDoes) {
  in_.body.estimated_velocity_m_s = {0.0, 2.0, 0.0};
  along_.roll_rad = -0.15;
  tilt(-0.15, true);
  EXPECT_EQ(after(0.1), Fall::kNone) << "it slides";
  tilt(-0.3, true);
  EXPECT_EQ(after(0.1), Fall::kFalls);
  along_.roll_rad = 0.15;
  falls_.begin_anew();
  tilt(0.0, true);
  EXPECT_EQ(after(0.1), Fall::kFalls);
  tilt(0.71, true);
  along_.roll_rad = 0.71;
  EXPECT_EQ(after(0.002), Fall::kLies) << "gravity's";
}

TEST_F(FallDetectorTest, AfterAPauseOneBadSampleIsNoFall) {
  EXPECT_EQ(after(0.1), Fall::kNone);
  falls_.begin_anew();
  in_.stamp.utime_us += 1'000'000;
  tilt(-0.12, true);
  in_.body.estimated_velocity_m_s = {0.0, 2.0, 0.0};
  EXPECT_EQ(after(0.002), Fall::kNone);
}

TEST_F(FallDetectorTest, NoseThatIsHeldUpAndThenTiltedIsNoFallAtOnce) {
  hold(false, false, true, true);
  EXPECT_EQ(after(3.0, kStands), Fall::kNone);
  tilt(-0.25, false);
  EXPECT_EQ(after(1.4, kStands), Fall::kNone);
  EXPECT_EQ(after(0.2, kStands), Fall::kLies);
}

TEST_F(FallDetectorTest, RobotThatSlidesWithoutTippingIsNoneThatWillFall) {
  tilt(0.08, true);
  in_.body.estimated_velocity_m_s = {0.0, 3.0, 0.0};
  EXPECT_EQ(after(0.5), Fall::kNone);
}

TEST_F(FallDetectorTest, LegsAloneDoNotShowThatItWillFall) {
  in_.body.uses_imu = false;
  tilt(0.2, true);
  in_.body.estimated_velocity_m_s = {0.0, 3.0, 0.0};
  EXPECT_EQ(after(0.5), Fall::kNone);
}

TEST_F(FallDetectorTest, NeighboursWithoutGroundForLongerThanASwingAreAFallWhereItIsTilted) {
  hold(true, true, false, false);
  tilt(0.25, false);
  EXPECT_EQ(after(1.5 + kSwing_s - 0.01), Fall::kNone);
  hold(true, true, true, false);
  EXPECT_EQ(after(0.002), Fall::kNone);
  hold(true, true, false, false);
  EXPECT_EQ(after(1.5 + kSwing_s - 0.01), Fall::kNone) << "it counts anew";
  EXPECT_EQ(after(0.02), Fall::kLies);
  tilt(0.1, false);
  EXPECT_EQ(after(0.02), Fall::kNone) << "nearly level: a step, or a hand";
}

TEST_F(FallDetectorTest, WithoutAnImuNeighboursWithoutGroundAreEnough) {
  in_.body.uses_imu = false;
  hold(false, true, false, true);
  EXPECT_EQ(after(0.5 + kSwing_s + 0.01), Fall::kLies);
}

TEST_F(FallDetectorTest, DiagonalFeetThatTakeTurnsAreATrot) {
  in_.body.uses_imu = false;
  for (int i = 0; i < 10; ++i) {
    hold(i % 2 == 0, i % 2 == 1, i % 2 == 1, i % 2 == 0);
    EXPECT_EQ(after(0.6), Fall::kNone);
  }
}

TEST_F(FallDetectorTest, RobotThatHangsIsNoneThatFellUnlessItWalks) {
  in_.body.uses_imu = false;
  hold(false, false, false, false);
  EXPECT_EQ(after(2.0, kStands), Fall::kNone);
  EXPECT_EQ(after(2.0), Fall::kLies);
  falls_.begin_anew();
  EXPECT_EQ(after(0.5), Fall::kNone);
}

TEST_F(FallDetectorTest, WhatIsNotKnownSaysNothing) {
  for (double& q : in_.body.estimated_quaternion_wxyz) q = kNaN;
  in_.body.estimated_height_m = kNaN;
  in_.body.estimated_velocity_m_s = {kNaN, kNaN, kNaN};
  EXPECT_EQ(after(0.1), Fall::kNone);
  EXPECT_EQ(falls_.why_not_up(in_.body), nullptr);
}

TEST_F(FallDetectorTest, RobotWithoutABodyCannotFall) {
  robot_.body = BodyConfig{};
  falls_ = FallDetector(robot_);
  tilt(2.0, true);
  EXPECT_EQ(after(0.1), Fall::kNone);
  EXPECT_EQ(falls_.why_not_up(in_.body), nullptr);
}

TEST_F(FallDetectorTest, GettingUpIsRefusedOnASideOrBackButNotLyingFlat) {
  tilt(0.05, false);
  in_.body.estimated_height_m = 0.08;
  EXPECT_EQ(falls_.why_not_up(in_.body), nullptr);
  tilt(1.5, true);
  EXPECT_STREQ(falls_.why_not_up(in_.body), "lying on its side or back: turn it over");
  tilt(3.1, false);
  EXPECT_STREQ(falls_.why_not_up(in_.body), "lying on its side or back: turn it over");
}

TEST_F(FallDetectorTest, WithoutAnImuTheFeetDoNotSayHowItLies) {
  tilt(1.5, true);
  in_.body.uses_imu = false;
  EXPECT_EQ(falls_.why_not_up(in_.body), nullptr);
}

}  // namespace
}  // namespace sprung
