#include "planner/leg_gains.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class LegGainsTest : public testing::Test {
 protected:
  bool compliant_in(JumpMode mode, MotionPhase phase, double in_phase_s, double since_thrust_s = 0.0) const {
    return compliant({phase, mode, in_phase_s, since_thrust_s, preset_.hybrid_switch_s}, preset_);
  }
  PresetConfig preset_ = load_robot("single_leg").preset("paper");
};

TEST_F(LegGainsTest, PositionModeIsNeverCompliant) {
  for (int p = 0; p <= static_cast<int>(MotionPhase::kSitting); ++p) {
    EXPECT_FALSE(compliant_in(JumpMode::kPosition, static_cast<MotionPhase>(p), 10.0, 10.0));
  }
}

TEST_F(LegGainsTest, TorqueModeIsCompliantFromTheEndOfTheCrouchThroughLanding) {
  EXPECT_FALSE(compliant_in(JumpMode::kTorque, MotionPhase::kCrouch, 0.499));
  EXPECT_TRUE(compliant_in(JumpMode::kTorque, MotionPhase::kCrouch, 0.5));
  EXPECT_TRUE(compliant_in(JumpMode::kTorque, MotionPhase::kThrust, 0.0));
  EXPECT_TRUE(compliant_in(JumpMode::kTorque, MotionPhase::kFlight, 0.0));
  EXPECT_TRUE(compliant_in(JumpMode::kTorque, MotionPhase::kLanding, 0.0));
  EXPECT_FALSE(compliant_in(JumpMode::kTorque, MotionPhase::kRecover, 0.0));
  EXPECT_FALSE(compliant_in(JumpMode::kTorque, MotionPhase::kStanding, 9.0));
}

TEST_F(LegGainsTest, HybridSwitchesByTimeOrTouchdownWhicheverIsFirst) {
  EXPECT_FALSE(compliant_in(JumpMode::kHybrid, MotionPhase::kCrouch, 0.6));
  EXPECT_FALSE(compliant_in(JumpMode::kHybrid, MotionPhase::kThrust, 0.1, 0.1));
  EXPECT_FALSE(compliant_in(JumpMode::kHybrid, MotionPhase::kFlight, 0.1, preset_.hybrid_switch_s - 0.001));
  EXPECT_TRUE(compliant_in(JumpMode::kHybrid, MotionPhase::kFlight, 0.1, preset_.hybrid_switch_s));
  EXPECT_TRUE(compliant_in(JumpMode::kHybrid, MotionPhase::kLanding, 0.0, 0.1));
  EXPECT_FALSE(compliant_in(JumpMode::kHybrid, MotionPhase::kRecover, 0.0, 1.0));
}

TEST_F(LegGainsTest, GainsAreThoseOfTheMode) {
  DesiredLeg leg;
  set_control({MotionPhase::kThrust, JumpMode::kTorque, 0.0, 0.0, 0.23}, preset_, leg);
  EXPECT_EQ(leg.control_mode, ControlMode::kCompliance);
  EXPECT_EQ(leg.stiffness_N_m, preset_.torque_jump.stiffness_N_m);
  EXPECT_EQ(leg.velocity_feedforward, preset_.torque_jump.velocity_feedforward);
  EXPECT_EQ(leg.friction_compensation, 1.0);
  set_control({MotionPhase::kLanding, JumpMode::kHybrid, 0.0, 0.6, 0.23}, preset_, leg);
  EXPECT_EQ(leg.damping_N_s_m, preset_.hybrid_landing.damping_N_s_m);
  EXPECT_EQ(leg.velocity_feedforward, 0.0);
  set_control({MotionPhase::kStanding, JumpMode::kHybrid, 0.0, 0.0, 0.23}, preset_, leg);
  EXPECT_EQ(leg.control_mode, ControlMode::kPosition);
  EXPECT_EQ(leg.stiffness_N_m, (Vec3{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace sprung
