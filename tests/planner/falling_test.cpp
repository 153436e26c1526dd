/// `land` from command to LEG_COMMAND.
#include <cmath>

#include "planner/jump.h"
#include "tests/planner/planner_fixture.h"

namespace sprung {
namespace {

class FallingTest : public PlannerFixture {
 protected:
  std::int64_t send_land(JumpMode mode, double touchdown_in_s = 0.25) {
    OperatorCommand command;
    command.kind = OperatorKind::kLand;
    command.jump_mode = mode;
    command.touchdown_in_s = touchdown_in_s;
    return send(command);
  }
  void hang() {
    stand_up();
    set_contact(false);
    cycle();
  }
};

TEST_F(FallingTest, FallGoesThroughLandingToTheStandOnMeasuredContact) {
  hang();
  const std::int64_t id = send_land(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  EXPECT_EQ(motion_.jump_mode, JumpMode::kHybrid);
  run(0.25);
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);  // time alone is no touchdown
  set_contact(true);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kLanding);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(id), "accepted done");
  EXPECT_EQ(motion_.jumps_left, 0);
}

TEST_F(FallingTest, FootGoesToItsLandingLengthWithoutAStepAndIsThenSoft) {
  hang();
  Vec3 before = desired().desired_foot_in_hip_m;
  send_land(JumpMode::kHybrid);
  for (int k = 0; k < 100; ++k) {
    cycle();
    EXPECT_LT(std::abs(desired().desired_foot_in_hip_m[2] - before[2]), 2e-3);
    EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
    before = desired().desired_foot_in_hip_m;
  }
  run(0.002);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.landing_length_m, 1e-12);
  EXPECT_EQ(desired().control_mode, ControlMode::kCompliance);
  EXPECT_EQ(desired().stiffness_N_m, preset_.hybrid_landing.stiffness_N_m);
}

TEST_F(FallingTest, EveryModeHasItsControl) {
  for (const JumpMode mode :
       {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kAdaptive}) {
    hang();
    send_land(mode);
    run(0.2);
    const bool soft = mode == JumpMode::kTorque || mode == JumpMode::kHybrid;
    if (mode != JumpMode::kAdaptive) {
      EXPECT_EQ(desired().control_mode, soft ? ControlMode::kCompliance : ControlMode::kPosition);
    }
    EXPECT_EQ(motion_.jump_mode, mode);
    set_contact(true);
    run_until(MotionPhase::kLanding);
    run_until(MotionPhase::kStanding);
  }
}

TEST_F(FallingTest, LegThatIsMovedToItsLandingLengthIsNoTouchdown) {
  hang();
  send_land(JumpMode::kHybrid, 0.4);
  run(0.02);
  set_contact(true);
  run(0.08);
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  run(kTouchdownGuard_s + 0.003);
  EXPECT_EQ(motion_.state, MotionPhase::kLanding);
}

TEST_F(FallingTest, GroundThatDoesNotComeEndsItWithAReason) {
  hang();
  const std::int64_t id = send_land(JumpMode::kPosition, 0.3);
  cycle();
  EXPECT_NEAR(run_until(MotionPhase::kLanding), 0.3 + preset_.flight_timeout_s, 0.003);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(id), "accepted failed");
  EXPECT_EQ(last_reason(id), "flight time-out: no touchdown measured");
}

TEST_F(FallingTest, RefusalsSayWhy) {
  const std::int64_t lying = send_land(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(last_reason(lying), "not standing: stand first");
  hang();
  for (const double wrong : {kNaN, 0.0, -0.2, 0.01, 1.1}) {
    const std::int64_t id = send_land(JumpMode::kHybrid, wrong);
    cycle();
    EXPECT_EQ(last_reason(id), "touchdown must be expected in 0.02 to 1 s");
  }
  const std::int64_t id = send_land(static_cast<JumpMode>(9));
  cycle();
  EXPECT_EQ(last_reason(id), "jump mode must be position, torque, hybrid or adaptive");
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(FallingTest, SafetyStaysOnInTheFall) {
  hang();
  const std::int64_t id = send_land(JumpMode::kAdaptive);
  run(0.1);
  state_.safety = SafetyLevel::kQuickStop;
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(outcomes(id), "accepted failed");
}

TEST_F(FallingTest, JumpAfterAFallFollowsItsOwnCurveAgain) {
  hang();
  send_land(JumpMode::kHybrid);
  run(0.25);
  set_contact(true);
  run_until(MotionPhase::kLanding);
  run_until(MotionPhase::kStanding);
  jump_to(MotionPhase::kThrust);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.jump_curve.lengths_m.front(), 1e-12);
}

}  // namespace
}  // namespace sprung
