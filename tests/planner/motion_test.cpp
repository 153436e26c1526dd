#include "planner/motion.h"

#include <cmath>

#include "tests/planner/planner_fixture.h"

namespace sprung {
namespace {

class MotionTest : public PlannerFixture {};

TEST_F(MotionTest, IdleAsksForNoPower) {
  run(0.1);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(leg_.stamp.seq, state_.stamp.seq);
  EXPECT_EQ(leg_.used_joint_state_seq, state_.stamp.seq);
}

TEST_F(MotionTest, StandHoldsTheMeasuredFootUntilEveryDriveIsEnabled) {
  set_enabled(false);
  send(OperatorKind::kStand);
  run(0.3);
  EXPECT_EQ(motion_.state, MotionPhase::kRising);
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
  set_foot({0.03, 0.0, -0.31});
  cycle();
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.03, 0.0, -0.31}));
  state_.joints[0].drive_enabled = true;
  run(0.1);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.03, 0.0, -0.31}));
  set_enabled(true);
  cycle();
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.03, 0.0, -0.31}));  // the move begins here
  run(preset_.rise_time_s / 2);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -(0.31 + preset_.stand_length_m) / 2, 1e-12);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.0, 0.0, -preset_.stand_length_m}));
}

TEST_F(MotionTest, StandWaitsForAnEstimatorThatStillSettles) {
  state_.joints[0].status = JointStatus::kStarting;
  send(OperatorKind::kStand);
  run(0.3);
  EXPECT_EQ(motion_.state, MotionPhase::kRising);
  EXPECT_EQ(desired().desired_foot_in_hip_m, state_.legs[0].estimated_foot_in_hip_m);
  state_.joints[0].status = JointStatus::kOk;
  EXPECT_NEAR(run_until(MotionPhase::kStanding), preset_.rise_time_s, 0.003);
}

TEST_F(MotionTest, DrivesThatStayOffEndTheStand) {
  set_enabled(false);
  const std::int64_t id = send(OperatorKind::kStand);
  run(kEnableTimeout_s - 0.01);
  EXPECT_EQ(motion_.state, MotionPhase::kRising);
  run(0.02);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(outcomes(id), "accepted failed");
  EXPECT_EQ(last_reason(id), "drives were not enabled within the time-out");
}

TEST_F(MotionTest, MissingFootEndsTheStand) {
  set_enabled(false);
  const std::int64_t id = send(OperatorKind::kStand);
  run(0.1);
  set_foot({kNaN, kNaN, kNaN});
  set_enabled(true);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  EXPECT_EQ(outcomes(id), "accepted failed");
}

TEST_F(MotionTest, JumpGoesThroughAllPhasesOnMeasuredConditions) {
  stand_up();
  const std::int64_t id = send_jump(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kCrouch);
  EXPECT_NEAR(run_until(MotionPhase::kThrust), preset_.crouch_time_s + preset_.settle_time_s, 0.003);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.jump_curve.lengths_m.front(), 1e-12);
  EXPECT_EQ(desired().phase, LegPhase::kThrust);
  run(0.09);
  EXPECT_EQ(motion_.state, MotionPhase::kThrust);  // time alone is no lift-off
  set_contact(false);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  run(0.4);
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  set_contact(true);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kLanding);
  EXPECT_NEAR(run_until(MotionPhase::kRecover), preset_.landing_hold_s, 0.003);
  EXPECT_EQ(motion_.jumps_done, 1);
  EXPECT_NEAR(run_until(MotionPhase::kStanding), preset_.recover_time_s + preset_.settle_time_s, 0.003);
  EXPECT_EQ(outcomes(id), "accepted done");
}

TEST_F(MotionTest, CurveIsPlayedByTimeThroughFlightAndThenHoldsTheLandingLength) {
  stand_up();
  jump_to(MotionPhase::kFlight, JumpMode::kPosition);
  JumpCurve curve(preset_);
  const double t = 0.15;
  while (motion_.legs[0].phase_time_s < 0.03) cycle();
  EXPECT_LT(std::abs(desired().desired_foot_in_hip_m[2] - curve.at(t).position_m[2]), 0.03);
  EXPECT_GT(desired().desired_foot_velocity_m_s[2], 0.0);  // flexing
  run(0.2);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.landing_length_m, 1e-12);
}

TEST_F(MotionTest, ContactDuringTheCurveIsNoTouchdown) {
  stand_up();
  jump_to(MotionPhase::kFlight);
  set_contact(true);  // the leg's own deceleration
  run(0.03);
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  set_contact(false);
  run(0.3);
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
}

TEST_F(MotionTest, LegThatIsDrawnInAgainHasLiftedOff) {
  stand_up();
  jump_to(MotionPhase::kThrust);
  const double longest_m = -state_.legs[0].estimated_foot_in_hip_m[2] + 0.2;
  for (double length_m = longest_m - 0.2; length_m < longest_m; length_m += 0.002) {
    set_foot({0.0, 0.0, -length_m});
    cycle();
    ASSERT_EQ(motion_.state, MotionPhase::kThrust);
  }
  set_foot({0.0, 0.0, -(longest_m - 0.012)});
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  EXPECT_STREQ(motion_.last_transition, "lift-off: the leg is drawn in again");
}

TEST_F(MotionTest, ShortDipEarlyInTheThrustIsNoLiftOff) {
  stand_up();
  jump_to(MotionPhase::kThrust);
  const double crouch_m = preset_.jump_curve.lengths_m.front();
  for (const double length_m : {crouch_m, crouch_m + 0.03, crouch_m - 0.01}) {
    set_foot({0.0, 0.0, -length_m});
    cycle();
  }
  EXPECT_EQ(motion_.state, MotionPhase::kThrust);
}

TEST_F(MotionTest, ThrustWithoutLiftOffEndsInTheLandingAndFailsTheJump) {
  stand_up();
  jump_to(MotionPhase::kThrust, JumpMode::kPosition, 3);
  EXPECT_NEAR(run_until(MotionPhase::kLanding), preset_.thrust_timeout_s, 0.003);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(jump_id_), "accepted failed");
  EXPECT_EQ(last_reason(jump_id_), "thrust time-out: no lift-off measured");
  EXPECT_EQ(motion_.jumps_done, 1);
}

TEST_F(MotionTest, FlightWithoutTouchdownEndsInTheLandingAndFailsTheJump) {
  stand_up();
  jump_to(MotionPhase::kFlight);
  EXPECT_NEAR(run_until(MotionPhase::kLanding), preset_.flight_timeout_s, 0.003);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(last_reason(jump_id_), "flight time-out: no touchdown measured");
}

TEST_F(MotionTest, HybridIsPositionUntilTheSwitchAndSoftAfterIt) {
  stand_up();
  jump_to(MotionPhase::kThrust);
  set_contact(false);
  run(0.228);
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
  run(0.004);
  EXPECT_EQ(desired().control_mode, ControlMode::kCompliance);
  EXPECT_EQ(desired().stiffness_N_m, preset_.hybrid_landing.stiffness_N_m);
}

TEST_F(MotionTest, RecoverBeginsWhereACompliantLegReallyIs) {
  stand_up();
  jump_to(MotionPhase::kLanding);
  set_foot({0.01, 0.0, -0.40});
  run_until(MotionPhase::kRecover);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.01, 0.0, -0.40}));
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
}

TEST_F(MotionTest, RecoverUnderPositionControlGoesOnFromTheDesiredFoot) {
  stand_up();
  jump_to(MotionPhase::kLanding, JumpMode::kPosition);
  set_foot({0.01, 0.0, -0.44});
  run_until(MotionPhase::kRecover);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.landing_length_m, 1e-12);
}

TEST_F(MotionTest, SeveralJumpsAreCounted) {
  stand_up();
  jump_to(MotionPhase::kLanding, JumpMode::kHybrid, 2);
  EXPECT_EQ(motion_.jumps_left, 2);
  run_until(MotionPhase::kThrust);
  EXPECT_EQ(motion_.jumps_done, 1);
  EXPECT_EQ(motion_.jumps_left, 1);
  run(0.1);
  set_contact(false);
  run(0.4);
  set_contact(true);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(motion_.jumps_done, 2);
  EXPECT_EQ(outcomes(jump_id_), "accepted done");
}

TEST_F(MotionTest, DesiredFootNeverStepsOutsideCompliance) {
  stand_up();
  Vec3 before = desired().desired_foot_in_hip_m;
  send_jump(JumpMode::kPosition);
  for (int k = 0; k < 4000; ++k) {
    if (motion_.state == MotionPhase::kThrust && motion_.legs[0].phase_time_s > 0.1) set_contact(false);
    if (motion_.state == MotionPhase::kFlight && motion_.legs[0].phase_time_s > 0.4) set_contact(true);
    cycle();
    EXPECT_LT(std::abs(desired().desired_foot_in_hip_m[2] - before[2]), 5e-3) << name(motion_.state);
    before = desired().desired_foot_in_hip_m;
  }
  EXPECT_EQ(motion_.jumps_done, 1);
}

}  // namespace
}  // namespace sprung
