/// A jump's height: what is asked of the curve, what is estimated, and what the next jump learns.
#include <cmath>

#include "planner/ballistics.h"
#include "planner/jump.h"
#include "tests/planner/planner_fixture.h"

namespace sprung {
namespace {

/// A leg that follows its curve exactly, thrown up at a chosen speed.
class JumpHeightTest : public testing::Test {
 protected:
  JumpHeightTest() {
    preset_ = robot_.preset("best");
    preset_.adapt_height = true;
  }
  JointState at(double time_s, double length_m, double speed_m_s, bool contact) const {
    JointState in(2, 1);
    in.stamp.utime_us = std::llround(1e6 * time_s);
    in.legs[0].estimated_foot_in_hip_m = {0.0, 0.0, -length_m};
    in.legs[0].estimated_foot_velocity_m_s = {0.0, 0.0, -speed_m_s};
    in.legs[0].contact = contact;
    return in;
  }
  /// Extends at 1.8 m/s from the crouch, leaves at 0.52 m, and is at its landing length when the ground
  /// comes.
  void jump(Jump& jump, double rise_m) const {
    const double crouch_m = preset_.jump_curve.lengths_m.front();
    const double leave_s = (kLeave_m - crouch_m) / kSpeed_m_s;
    jump.begin_thrust(at(0.0, crouch_m, 0.0, true));
    for (double t = 0.001; t < leave_s; t += 0.001)
      ASSERT_FALSE(jump.in_thrust(at(t, crouch_m + kSpeed_m_s * t, kSpeed_m_s, true), t));
    ASSERT_EQ(jump.in_thrust(at(leave_s, kLeave_m, kSpeed_m_s, false), leave_s), MotionEvent::kLiftOff);
    const double up_m_s = std::sqrt(2.0 * kGravity_m_s2 * rise_m);
    const double down_m_s = std::sqrt(up_m_s * up_m_s +
                                      2.0 * kGravity_m_s2 * (kLeave_m - preset_.landing_length_m));
    const double flight_s = (up_m_s + down_m_s) / kGravity_m_s2;
    const double land_s = leave_s + flight_s;
    ASSERT_FALSE(jump.in_flight(at(land_s - 0.001, preset_.landing_length_m, 0.0, false), flight_s));
    ASSERT_EQ(jump.in_flight(at(land_s, preset_.landing_length_m, 0.0, true), flight_s),
              MotionEvent::kTouchdown);
  }
  static constexpr double kLeave_m = 0.52;
  static constexpr double kSpeed_m_s = 1.7155 / kFirmShare;  // the hip has 1.7155 m/s for 0.15 m
  RobotConfig robot_ = load_robot("single_leg");
  PresetConfig preset_;
};

TEST_F(JumpHeightTest, HeightIsEstimatedFromLengthsAndFlightTime) {
  Jump one(robot_, preset_);
  one.begin(JumpRequest{});
  EXPECT_TRUE(std::isnan(one.estimated_height_m()));
  jump(one, 0.15);
  EXPECT_NEAR(one.estimated_height_m(), 0.15, 0.001);
}

TEST_F(JumpHeightTest, NextJumpIsShapedByWhatTheLastOneReached) {
  Jump one(robot_, preset_);
  one.begin({JumpMode::kHybrid, 3, 0.15, 0.0});
  const double first = one.curve().factor();
  jump(one, 0.12);
  one.shape();
  EXPECT_GT(one.curve().factor(), first);
  EXPECT_NEAR(height_share(one.curve().factor()), height_share(first) * 0.15 / one.estimated_height_m(),
              1e-3);
  one.begin({JumpMode::kHybrid, 1, 0.15, 0.0});  // and across commands
  EXPECT_GT(one.curve().factor(), first);
}

TEST_F(JumpHeightTest, PresetThatDoesNotAdaptRepeatsItself) {
  preset_.adapt_height = false;
  Jump one(robot_, preset_);
  one.begin({JumpMode::kHybrid, 3, 0.15, 0.0});
  const double first = one.curve().factor();
  jump(one, 0.12);
  one.shape();
  EXPECT_EQ(one.curve().factor(), first);
}

TEST_F(JumpHeightTest, PresetsOwnCurveIsNeverChanged) {
  Jump one(robot_, preset_);
  one.begin({JumpMode::kHybrid, 3, 0.15, 0.0});
  jump(one, 0.10);
  one.begin(JumpRequest{});
  EXPECT_EQ(one.curve().factor(), 1.0);
}

TEST_F(JumpHeightTest, TouchdownIsExpectedFromTheLegsSpeedAndLaterFromExperience) {
  Jump one(robot_, preset_);
  one.begin({JumpMode::kHybrid, 2, 0.15, 0.0});
  jump(one, 0.25);  // soft ground throws the hip up faster than the leg extends
  const auto first_us = one.expected().utime_us;
  jump(one, 0.25);
  EXPECT_GT(one.expected().utime_us, first_us + 10000);
}

TEST_F(JumpHeightTest, ContactThatIsLostAtTheStartOfTheThrustIsNoLiftOff) {
  Jump one(robot_, preset_);
  one.begin(JumpRequest{});
  const double crouch_m = preset_.jump_curve.lengths_m.front();
  one.begin_thrust(at(0.0, crouch_m, 0.0, true));
  EXPECT_FALSE(one.in_thrust(at(0.009, crouch_m + 0.001, 0.3, false), 0.009));
  EXPECT_FALSE(one.in_thrust(at(0.010, crouch_m + 0.001, 0.3, true), 0.010));
}

TEST_F(JumpHeightTest, UnreachableHeightsAreRefusedWithTheLimit) {
  const Jump one(robot_, preset_);
  const auto validate = [&](double height_m, double forward_m = 0.0) {
    const char* why = one.validate({JumpMode::kHybrid, 1, height_m, forward_m});
    return std::string(why == nullptr ? "" : why);
  };
  EXPECT_EQ(validate(0.0), "");
  EXPECT_EQ(validate(0.15), "");
  EXPECT_EQ(validate(0.15, 0.04), "");
  for (const double wrong : {0.02, 2.0, -0.1, kNaN})
    EXPECT_EQ(validate(wrong).rfind("jump height must be ", 0), 0U) << validate(wrong);
  EXPECT_NE(validate(2.0).find("too "), std::string::npos) << validate(2.0);  // and why
  for (const double wrong : {0.6, -0.6, kNaN})
    EXPECT_EQ(validate(0.15, wrong), "distance forward must be -500 to 500 mm");
}

}  // namespace
}  // namespace sprung
