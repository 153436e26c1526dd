#include "drivers/bridge/hard_limit_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/bridge/safety_machine.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

/// Joints within 1 rad either way, actuators up to 12 rad/s, cycles of 1 ms.
class HardLimits : public ::testing::Test {
 protected:
  /// One cycle. @return the cause of the fault there is, kNone without.
  SafetyCause cycle(double position_rad, double velocity_rad_s = 0.0, bool enabled = true) {
    for (GateMotion& m : motion_) m = {0.0, 0.0, 0.0, enabled, false};
    motion_[1].measured_position_rad = position_rad;
    motion_[1].filtered_velocity_rad_s = velocity_rad_s;
    watch_.judge(motion_, time_us_ += 1000);
    fault_ = Fault();
    return watch_.fault(fault_) ? fault_.cause : SafetyCause::kNone;
  }

  /// The same for 30 ms.
  SafetyCause held(double position_rad, bool enabled = true) {
    for (int i = 0; i < 29; ++i) cycle(position_rad, 0.0, enabled);
    return cycle(position_rad, 0.0, enabled);
  }

  HardLimitWatch watch_{test::with_leg(test::two_drive_robot(), 1.0)};
  std::vector<GateMotion> motion_{2};
  std::int64_t time_us_ = 0;
  Fault fault_;
};

TEST_F(HardLimits, LittleBeyondIsTheSoftStopsBusiness) {
  EXPECT_EQ(cycle(0.9), SafetyCause::kNone);
  EXPECT_EQ(held(1.079), SafetyCause::kNone);
}

TEST_F(HardLimits, FarBeyondIsAFaultWithJointAndNumbers) {
  cycle(-0.9);
  EXPECT_EQ(held(-1.09), SafetyCause::kJointLimit);
  EXPECT_EQ(fault_.actuator, 1);
  EXPECT_THAT(fault_.detail.data(), HasSubstr("joint1: at -1.09 rad, beyond its limits of -1 to 1 rad"));
}

TEST_F(HardLimits, PushIntoAStopThatSpringsBackIsNone) {
  cycle(0.9);
  for (int i = 0; i < 29; ++i) ASSERT_EQ(cycle(1.09), SafetyCause::kNone) << i;
  EXPECT_EQ(cycle(1.07), SafetyCause::kNone);
  for (int i = 0; i < 29; ++i) ASSERT_EQ(cycle(1.09), SafetyCause::kNone) << i;
  EXPECT_EQ(cycle(1.09), SafetyCause::kJointLimit);
}

TEST_F(HardLimits, WithoutPowerAJointMayBeAnywhere) {
  EXPECT_EQ(held(3.0, false), SafetyCause::kNone);
  EXPECT_EQ(cycle(-3.0, 100.0, false), SafetyCause::kNone);
}

TEST_F(HardLimits, JointThatWasOutsideWhenPowerCameMayComeBackButGoNoFurther) {
  held(1.5, false);
  EXPECT_EQ(held(1.5), SafetyCause::kNone);
  EXPECT_EQ(held(1.515), SafetyCause::kNone);
  EXPECT_EQ(held(1.525), SafetyCause::kJointLimit);
}

TEST_F(HardLimits, WhatHasComeBackIsGivenUp) {
  for (const double outside : {1.5, 1.3, 1.1}) EXPECT_EQ(held(outside), SafetyCause::kNone);
  EXPECT_EQ(held(1.2), SafetyCause::kJointLimit);
}

TEST_F(HardLimits, JointWhoseActuatorIsNotKnownIsNotJudged) { EXPECT_EQ(cycle(kNaN), SafetyCause::kNone); }

TEST_F(HardLimits, TooFastForTwentyMillisecondsIsAFault) {
  cycle(0.0, -14.0);
  for (int i = 0; i < 19; ++i) ASSERT_EQ(cycle(0.0, -14.5), SafetyCause::kNone) << i;
  cycle(0.0, -14.0);
  for (int i = 0; i < 19; ++i) ASSERT_EQ(cycle(0.0, -14.5), SafetyCause::kNone) << i;
  EXPECT_EQ(cycle(0.0, -14.5), SafetyCause::kOverspeed);
  EXPECT_THAT(fault_.detail.data(), HasSubstr("knee_motor: -14.5 rad/s for 20 ms, its limit is 12.0 rad/s"));
}

}  // namespace
}  // namespace sprung
