/// Moving single joints, seen from the planner's outside: phases, replies, what LEG_COMMAND says.
#include <cmath>
#include <set>

#include "planner/motion.h"
#include "tests/planner/planner_fixture.h"
#include "tests/support/allocation_count.h"
#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

class PlannerJointTest : public PlannerFixture {
 protected:
  PlannerJointTest() {
    state_.joints[0].estimated_position_rad = 1.6;
    state_.joints[1].estimated_position_rad = 0.5;
  }
  std::int64_t move(double target_rad, int joint = 1, double speed_rad_s = 1.0,
                    double acceleration_rad_s2 = 4.0) {
    OperatorCommand command;
    command.kind = OperatorKind::kMoveJoint;
    command.joint = joint;
    command.joint_target_rad = target_rad;
    command.joint_speed_rad_s = speed_rad_s;
    command.joint_acceleration_rad_s2 = acceleration_rad_s2;
    return send(command);
  }
  double angle(std::size_t joint) const { return desired().desired_joint_position_rad[joint]; }
};

TEST_F(PlannerJointTest, MovesFromIdleHoldsAndSaysDone) {
  const std::int64_t id = move(1.5);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kMovingJoint);
  EXPECT_EQ(outcomes(id), "accepted");
  EXPECT_EQ(desired().control_mode, ControlMode::kJoint);
  run(0.6);
  EXPECT_NEAR(desired().desired_joint_velocity_rad_s[1], 1.0, 1e-12);
  run(0.6);
  EXPECT_EQ(outcomes(id), "accepted");
  run(0.1);
  EXPECT_EQ(outcomes(id), "accepted done");
  EXPECT_EQ(last_reason(id), "joint move ended, joints held");
  EXPECT_NEAR(angle(1), 1.5, 1e-12);
  EXPECT_EQ(angle(0), 1.6);
  EXPECT_TRUE(std::isnan(angle(2)));
  run(5.0);
  EXPECT_EQ(motion_.state, MotionPhase::kMovingJoint);
  EXPECT_EQ(desired().control_mode, ControlMode::kJoint);
}

TEST_F(PlannerJointTest, NextMoveGoesOnFromThereWhateverWasMeasured) {
  move(1.5);
  run(2.0);
  state_.joints[1].estimated_position_rad = 1.47;  // friction and weight
  const std::int64_t id = move(1.9, 0);
  run(2.0);
  EXPECT_EQ(outcomes(id), "accepted done");
  EXPECT_NEAR(angle(0), 1.9, 1e-12);
  EXPECT_NEAR(angle(1), 1.5, 1e-12);
}

TEST_F(PlannerJointTest, HoldsWhatIsMeasuredUntilEveryDriveIsEnabled) {
  set_enabled(false);
  const std::int64_t id = move(1.5);
  cycle();
  EXPECT_EQ(angle(1), 0.5);
  state_.joints[1].estimated_position_rad = 0.52;
  run(0.3);
  EXPECT_EQ(angle(1), 0.52);
  EXPECT_EQ(desired().desired_joint_velocity_rad_s[1], 0.0);
  set_enabled(true);
  run(0.1);
  EXPECT_GT(angle(1), 0.52);
  run(2.0);
  EXPECT_EQ(outcomes(id), "accepted done");
}

TEST_F(PlannerJointTest, DrivesThatStayOffEndIt) {
  set_enabled(false);
  const std::int64_t id = move(1.5);
  run(kEnableTimeout_s + 0.01);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(outcomes(id), "accepted failed");
  EXPECT_EQ(last_reason(id), "drives were not enabled within the time-out");
}

TEST_F(PlannerJointTest, StopBrakesAsItSpedUpAndHolds) {
  const std::int64_t id = move(2.5);
  run(1.0);
  const double before_rad = angle(1);
  const std::int64_t stop = send(OperatorKind::kStop);
  cycle();
  EXPECT_GT(desired().desired_joint_velocity_rad_s[1], 0.9);
  run(0.3);
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(outcomes(id), "accepted failed");
  EXPECT_EQ(last_reason(id), "joint move stopped by the operator, joints held");
  EXPECT_NEAR(angle(1), before_rad + 1.0 / (2 * 4.0), 5e-3);
  EXPECT_EQ(motion_.state, MotionPhase::kMovingJoint);
  const std::int64_t again = move(2.5);
  run(3.0);
  EXPECT_EQ(outcomes(again), "accepted done");
}

TEST_F(PlannerJointTest, StopBeforeTheDrivesAreEnabledMovesNothing) {
  set_enabled(false);
  const std::int64_t id = move(1.5);
  run(0.1);
  const std::int64_t stop = send(OperatorKind::kStop);
  cycle();
  set_enabled(true);
  run(0.5);
  EXPECT_EQ(angle(1), 0.5);
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(outcomes(id), "accepted failed");
}

TEST_F(PlannerJointTest, StopWhileHoldingIsDone) {
  move(1.5);
  run(2.0);
  const std::int64_t stop = send(OperatorKind::kStop);
  cycle();
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(motion_.state, MotionPhase::kMovingJoint);
}

TEST_F(PlannerJointTest, SitLetsGoDampedAndThenSwitchesOffEvenDuringAMove) {
  const std::int64_t id = move(2.5);
  run(0.5);
  const std::int64_t sit = send(OperatorKind::kSit);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kSitting);
  EXPECT_EQ(outcomes(id), "accepted failed");
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  run(kSinkTime_s - 0.002);
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  EXPECT_EQ(outcomes(sit), "accepted");
  run(0.01);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(outcomes(sit), "accepted done");
}

TEST_F(PlannerJointTest, StandAfterItLowersItselfAsBefore) {
  move(1.5);
  run(2.0);
  send(OperatorKind::kSit);
  run(1.5);
  stand_up();
  send(OperatorKind::kSit);
  run(0.1);
  EXPECT_EQ(motion_.state, MotionPhase::kSitting);
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);  // a foot is lowered, not let go
}

TEST_F(PlannerJointTest, LostSafetyOrDriveLetsTheJointSink) {
  for (int what = 0; what < 3; ++what) {
    const std::int64_t id = move(what % 2 == 0 ? 2.0 : 0.7);
    run(0.4);
    if (what == 0) state_.safety = SafetyLevel::kDamping;
    if (what == 1) state_.joints[0].drive_enabled = false;
    if (what == 2) state_.joints[1].status = JointStatus::kFault;
    cycle();
    EXPECT_EQ(motion_.state, MotionPhase::kIdle);
    EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
    EXPECT_EQ(outcomes(id), "accepted failed");
    state_.safety = SafetyLevel::kOperational;
    set_enabled(true);
    state_.joints[1].status = JointStatus::kOk;
    run(kSinkTime_s);
    EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
  }
}

TEST_F(PlannerJointTest, WhatCannotBeDoneIsRefusedWithItsReason) {
  const auto reason = [&](std::int64_t id) {
    cycle();
    EXPECT_EQ(outcomes(id), "refused");
    EXPECT_EQ(motion_.state, MotionPhase::kIdle);
    return last_reason(id);
  };
  EXPECT_EQ(reason(move(1.5, 2)), "this robot has no such joint");
  EXPECT_EQ(reason(move(2.61)), "target is not within the joint's position limits (kept by 0.02 rad)");
  EXPECT_EQ(reason(move(kNaN)), "target is not within the joint's position limits (kept by 0.02 rad)");
  EXPECT_EQ(reason(move(1.5, 1, 12.1)), "speed must be positive and within the joint's speed limit");
  EXPECT_EQ(reason(move(1.5, 1, 1.0, kNaN)),
            "acceleration must be positive and within what the actuator can give its own armature");
  state_.joints[0].status = JointStatus::kNotReferenced;
  EXPECT_EQ(reason(move(1.5)), "a joint is not referenced: sprung home");
  state_.joints[0].status = JointStatus::kStale;
  EXPECT_EQ(reason(move(1.5)), "a joint is not ready: see its status");
  state_.joints[0].status = JointStatus::kOk;
  state_.safety = SafetyLevel::kDisabled;
  EXPECT_EQ(reason(move(1.5)), "safety is not operational: clear it first");
}

TEST_F(PlannerJointTest, OneMotionAtATime) {
  move(2.5);
  run(0.2);
  const std::int64_t second = move(1.0);
  const std::int64_t stand = send(OperatorKind::kStand);
  const std::int64_t jump = send_jump(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(last_reason(second), "busy: a joint is moving");
  EXPECT_EQ(last_reason(stand), "busy: single joints are held, sit first");
  EXPECT_EQ(last_reason(jump), "busy: single joints are held, sit first");
  send(OperatorKind::kSit);
  run(1.5);
  stand_up();
  const std::int64_t standing = move(1.0);
  cycle();
  EXPECT_EQ(last_reason(standing), "busy: standing, sit first");
}

TEST_F(PlannerJointTest, RestartedBridgeEndsIt) {
  move(2.5);
  run(0.5);
  state_.stamp = {500, -1};
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
}

TEST_F(PlannerJointTest, DesiredAnglesNeverStep) {
  Vec3 before{1.6, 0.5, 0.0};
  move(2.5, 1, 3.0, 20.0);
  for (int k = 0; k < 3000; ++k) {
    if (k == 1200) move(0.3, 1, 3.0, 20.0);
    if (k == 1500) send(OperatorKind::kStop);
    if (k == 2000) move(1.0, 0, 3.0, 20.0);
    cycle();
    for (std::size_t j = 0; j < 2; ++j) {
      ASSERT_LE(std::abs(angle(j) - before[j]), 3.0e-3 + 1e-9) << k;
      before[j] = angle(j);
    }
  }
  EXPECT_NEAR(angle(0), 1.0, 1e-12);
}

TEST_F(PlannerJointTest, NothingIsAllocatedInAMove) {
  const std::int64_t before = test::allocation_count();
  move(2.5);
  for (int k = 0; k < 3000; ++k) {
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    planner_.step(state_, leg_, motion_);
    OperatorReply reply;
    while (planner_.next_reply(reply)) continue;
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_NEAR(angle(1), 2.5, 1e-12);
}

TEST(PlannerJointWithoutKinematics, MovesOneOfTwelveJoints) {
  const RobotConfig robot = test::pegasus_without_feet();
  PlannerCore planner(robot, robot.preset("best"));
  JointState state(12, 4);
  state.safety = SafetyLevel::kOperational;
  for (std::size_t i = 0; i < 12; ++i) {
    state.joints[i].status = JointStatus::kOk;
    state.joints[i].drive_enabled = true;
    state.joints[i].estimated_position_rad = 0.1 + 0.1 * static_cast<double>(i);
  }
  LegCommand legs(4);
  MotionState motion(4);
  OperatorCommand move;
  move.kind = OperatorKind::kMoveJoint;
  move.request_id = 1;
  move.joint = 8;  // hl_knee
  move.joint_target_rad = 1.5;
  move.joint_speed_rad_s = 2.0;
  move.joint_acceleration_rad_s2 = 10.0;
  planner.submit(move);
  for (int k = 1; k < 500; ++k) {
    state.stamp = {2000 * k, k};
    planner.step(state, legs, motion);
  }
  EXPECT_EQ(motion.state, MotionPhase::kMovingJoint);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t index = 3 * leg + j;
      const double expected = index == 8 ? 1.5 : state.joints[index].estimated_position_rad;
      EXPECT_NEAR(legs.legs[leg].desired_joint_position_rad[j], expected, 1e-12);
    }
  }
}

}  // namespace
}  // namespace sprung
