#include "planner/planner_core.h"

#include "planner/height_law.h"
#include "planner/motion.h"
#include "tests/planner/planner_fixture.h"
#include "tests/support/allocation_count.h"
#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

class PlannerCoreTest : public PlannerFixture {};

TEST_F(PlannerCoreTest, JumpIsRefusedUnlessStanding) {
  const std::int64_t id = send_jump(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(outcomes(id), "refused");
  EXPECT_EQ(last_reason(id), "not standing: stand first");
  EXPECT_STREQ(motion_.last_transition, "not standing: stand first");
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
}

TEST_F(PlannerCoreTest, ImpossibleJumpsAreRefusedWithTheRange) {
  stand_up();
  for (double height : {0.01, 5.0, -0.1, kNaN}) {
    const std::int64_t id = send_jump(JumpMode::kHybrid, 1, height);
    cycle();
    EXPECT_EQ(last_reason(id).rfind("jump height must be ", 0), 0U) << last_reason(id);
  }
  for (int count : {0, -1, 101}) {
    const std::int64_t id = send_jump(JumpMode::kHybrid, count);
    cycle();
    EXPECT_EQ(last_reason(id), "jump count must be 1 to 100");
  }
  const std::int64_t id = send_jump(static_cast<JumpMode>(9));
  cycle();
  EXPECT_EQ(outcomes(id), "refused");
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(PlannerCoreTest, HeightSetsTheScale) {
  stand_up();
  send_jump(JumpMode::kTorque, 1, height_share(0.7) * preset_.jump_curve.height_m);
  cycle();
  EXPECT_NEAR(motion_.jump_height_scale, 0.7, 1e-12);
  EXPECT_EQ(motion_.jump_mode, JumpMode::kTorque);
}

TEST_F(PlannerCoreTest, StandWhileStandingIsDoneAtOnce) {
  stand_up();
  const std::int64_t id = send(OperatorKind::kStand);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
}

TEST_F(PlannerCoreTest, StandNeedsSafetyAndReadyJoints) {
  state_.safety = SafetyLevel::kDamping;
  std::int64_t id = send(OperatorKind::kStand);
  cycle();
  EXPECT_EQ(last_reason(id), "safety is not operational: clear it first");
  state_.safety = SafetyLevel::kOperational;
  for (JointStatus status : {JointStatus::kStale, JointStatus::kNotReferenced, JointStatus::kFault}) {
    state_.joints[1].status = status;
    id = send(OperatorKind::kStand);
    cycle();
    EXPECT_EQ(outcomes(id), "refused") << name(status);
  }
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
}

/// `sprung status` prints it: after a clear it may not go on saying that safety is not operational.
TEST_F(PlannerCoreTest, RefusalIsToldUntilSafetyHasChanged) {
  stand_up();
  state_.safety = SafetyLevel::kDamping;
  cycle();
  EXPECT_STREQ(motion_.last_transition, "stopped by safety");
  send(OperatorKind::kStand);
  run(0.1);
  EXPECT_STREQ(motion_.last_transition, "safety is not operational: clear it first");
  state_.safety = SafetyLevel::kOperational;
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_STREQ(motion_.last_transition, "stopped by safety");
}

TEST_F(PlannerCoreTest, SecondCommandWhileMovingIsBusy) {
  send(OperatorKind::kStand);
  cycle();
  const std::int64_t rising = send(OperatorKind::kStand);
  cycle();
  EXPECT_EQ(last_reason(rising), "busy: rising");
  run_until(MotionPhase::kStanding);
  set_contact(true);
  send_jump(JumpMode::kHybrid);
  cycle();
  const std::int64_t jumping = send(OperatorKind::kSit);
  cycle();
  EXPECT_EQ(last_reason(jumping), "busy: jumping");
  EXPECT_EQ(motion_.state, MotionPhase::kCrouch);
}

TEST_F(PlannerCoreTest, SitLowersAndSwitchesOff) {
  stand_up();
  const std::int64_t id = send(OperatorKind::kSit);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kSitting);
  run(preset_.rise_time_s - 0.01);
  EXPECT_NEAR(desired().desired_foot_in_hip_m[2], -preset_.sit_length_m, 1e-3);
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
  const std::int64_t stop = send(OperatorKind::kStop);
  run(0.05);
  EXPECT_EQ(outcomes(stop), "refused");
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(outcomes(id), "accepted done");
  const std::int64_t again = send(OperatorKind::kSit);
  cycle();
  EXPECT_EQ(outcomes(again), "accepted done");
}

TEST_F(PlannerCoreTest, StopBeforeTheThrustLeadsBackToTheStand) {
  stand_up();
  const std::int64_t jump = send_jump(JumpMode::kHybrid);
  run(0.3);
  const std::int64_t stop = send(OperatorKind::kStop);
  run(0.003);
  EXPECT_EQ(motion_.state, MotionPhase::kRecover);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(outcomes(jump), "accepted failed");
  EXPECT_EQ(motion_.jumps_done, 0);
}

TEST_F(PlannerCoreTest, StopInFlightFinishesThisJumpAndNoMore) {
  stand_up();
  jump_to(MotionPhase::kFlight, JumpMode::kHybrid, 5);
  const std::int64_t stop = send(OperatorKind::kStop);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kFlight);
  run(0.4);
  set_contact(true);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(motion_.jumps_done, 1);
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(outcomes(jump_id_), "accepted failed");
  jump_to(MotionPhase::kLanding);  // and the next one is not stopped
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(jump_id_), "accepted done");
}

TEST_F(PlannerCoreTest, StopWhileNothingMovesIsDone) {
  const std::int64_t id = send(OperatorKind::kStop);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
}

TEST_F(PlannerCoreTest, LostSafetyOrDriveIsIdleAtOnceInEveryPhaseAndTheLegSinks) {
  for (MotionPhase phase : {MotionPhase::kStanding, MotionPhase::kThrust, MotionPhase::kFlight,
                            MotionPhase::kLanding, MotionPhase::kRecover}) {
    for (int what = 0; what < 3; ++what) {
      stand_up();
      if (phase != MotionPhase::kStanding) jump_to(phase);
      if (what == 0) state_.safety = SafetyLevel::kQuickStop;
      if (what == 1) state_.joints[1].drive_enabled = false;
      if (what == 2) state_.joints[0].status = JointStatus::kFault;
      cycle();
      EXPECT_EQ(motion_.state, MotionPhase::kIdle) << name(phase);
      EXPECT_EQ(desired().control_mode, ControlMode::kDamping) << name(phase);
      EXPECT_STRNE(motion_.last_transition, "");
      if (phase != MotionPhase::kStanding) {
        EXPECT_EQ(outcomes(jump_id_), "accepted failed");
      }
      state_.safety = SafetyLevel::kOperational;
      set_enabled(true);
      state_.joints[0].status = JointStatus::kOk;
      set_contact(true);
    }
  }
}

TEST_F(PlannerCoreTest, LegSinksForASecondAndIsThenWithoutPower) {
  stand_up();
  state_.safety = SafetyLevel::kDamping;  // one stall, not latched
  cycle();
  state_.safety = SafetyLevel::kOperational;
  run(kSinkTime_s - 0.001);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  cycle();
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  run(2.0);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
}

TEST_F(PlannerCoreTest, StandCatchesALegThatSinks) {
  stand_up();
  state_.safety = SafetyLevel::kDamping;
  cycle();
  state_.safety = SafetyLevel::kOperational;
  run(0.3);
  set_foot({0.01, 0.0, -0.40});
  const std::int64_t id = send(OperatorKind::kStand);
  cycle();
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.01, 0.0, -0.40}));
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(id), "accepted done");
  const std::int64_t sit = send(OperatorKind::kSit);
  run_until(MotionPhase::kSitting);
  run_until(MotionPhase::kIdle);
  EXPECT_EQ(outcomes(sit), "accepted done");
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);  // sitting down is no loss
}

TEST_F(PlannerCoreTest, StalledDriveDoesNotEndTheMotionByItself) {
  stand_up();
  state_.joints[1].status = JointStatus::kStale;  // the controller damps, the bridge decides
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(PlannerCoreTest, RestartedBridgeIsIdleAndDropsWhatWaited) {
  stand_up();
  OperatorCommand later;
  later.kind = OperatorKind::kSit;
  later.apply_at_seq = 1000000;
  const std::int64_t waiting = send(later);
  state_.stamp = {500, -1};
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(outcomes(waiting), "refused");
  EXPECT_GE(motion_.legs[0].phase_time_s, 0.0);
}

TEST_F(PlannerCoreTest, RestartedBridgeEndsTheSinking) {
  stand_up();
  state_.joints[1].status = JointStatus::kFault;
  cycle();
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  state_.stamp = {500, -1};
  cycle();
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
}

TEST_F(PlannerCoreTest, CommandTakesEffectInItsCycle) {
  OperatorCommand command;
  command.kind = OperatorKind::kStand;
  command.apply_at_seq = 20;
  const std::int64_t id = send(command);
  run(0.019);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(outcomes(id), "");
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kRising);
  ASSERT_EQ(outcomes(id), "accepted");
  EXPECT_EQ(replies_.back().took_effect_at_seq, 20);
}

TEST_F(PlannerCoreTest, EstopAndClearAreTheBridgesToAnswer) {
  const std::int64_t id = send(OperatorKind::kEstop);
  cycle();
  EXPECT_EQ(outcomes(id), "");
  const std::int64_t unknown = send(static_cast<OperatorKind>(42));
  cycle();
  EXPECT_EQ(outcomes(unknown), "refused");
}

TEST_F(PlannerCoreTest, NothingIsAllocatedInAJump) {
  stand_up();
  send_jump(JumpMode::kTorque, 2);
  for (int k = 0; k < 4000; ++k) {
    set_contact(motion_.state != MotionPhase::kFlight && motion_.legs[0].phase_time_s < 0.1);
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    const std::int64_t before = test::allocation_count();
    planner_.step(state_, leg_, motion_);
    OperatorReply reply;
    while (planner_.next_reply(reply)) continue;
    ASSERT_EQ(test::allocation_count(), before);
  }
}

TEST_F(PlannerCoreTest, AllLegsOfARobotDoTheSame) {
  RobotConfig robot = robot_;
  robot.legs.push_back(robot.legs[0]);
  PlannerCore planner(robot, preset_);
  JointState state(2, 2);
  state.safety = SafetyLevel::kOperational;
  state.joints = state_.joints;
  state.legs = {state_.legs[0], state_.legs[0]};
  LegCommand legs(2);
  MotionState motion(2);
  OperatorCommand stand;
  stand.kind = OperatorKind::kStand;
  stand.request_id = 1;
  planner.submit(stand);
  for (int k = 0; k < 2000; ++k) {
    state.stamp = {1000 * k, k};
    planner.step(state, legs, motion);
  }
  EXPECT_EQ(motion.state, MotionPhase::kStanding);
  EXPECT_EQ(legs.legs[0].desired_foot_in_hip_m, legs.legs[1].desired_foot_in_hip_m);
}

TEST(PlannerWithoutFeet, HoldsStillAndRefusesToStandWithItsReason) {
  const RobotConfig robot = test::pegasus_without_feet();
  PlannerCore planner(robot, robot.preset("best"));
  JointState state(12, 4);
  state.safety = SafetyLevel::kOperational;
  for (EstimatedJoint& joint : state.joints) joint.status = JointStatus::kOk;
  LegCommand legs(4);
  MotionState motion(4);
  OperatorCommand stand;
  stand.kind = OperatorKind::kStand;
  planner.submit(stand);
  state.stamp = {2000, 1};
  planner.step(state, legs, motion);
  OperatorReply reply;
  ASSERT_TRUE(planner.next_reply(reply));
  EXPECT_EQ(reply.outcome, OperatorOutcome::kRefused);
  EXPECT_STREQ(reply.reason, "this robot's legs have no kinematics: it cannot stand");
  EXPECT_EQ(motion.state, MotionPhase::kIdle);
  for (const DesiredLeg& leg : legs.legs) EXPECT_EQ(leg.control_mode, ControlMode::kDisabled);
}

}  // namespace
}  // namespace sprung
