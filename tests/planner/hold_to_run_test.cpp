/// Maintenance mode: nothing moves unless somebody holds.
#include "robots/maintenance.h"
#include "robots/parameters.h"
#include "tests/planner/planner_fixture.h"

namespace sprung {
namespace {

class HoldToRunTest : public PlannerFixture {
 protected:
  HoldToRunTest() : PlannerFixture(for_maintenance(load_robot("single_leg"))) {}

  std::int64_t send_hold(double hold_s = 0.5, OperatorKind kind = OperatorKind::kEnable) {
    OperatorCommand command;
    command.kind = kind;
    command.hold_s = hold_s;
    return send(command);
  }
  void run_held(double seconds) {
    for (double t = 0.0; t < seconds; t += 0.1) {
      send_hold();
      run(0.1);
    }
  }
  void comply_for(double hold_s) {
    OperatorCommand comply;
    comply.kind = OperatorKind::kComply;
    comply.stiffness_N_m = {2000.0, kNaN, 2000.0};
    comply.damping_N_s_m = {40.0, kNaN, 40.0};
    comply.friction_compensation = 0.9;
    comply.hold_s = hold_s;
    send(comply);
    cycle();
    ASSERT_EQ(motion_.state, MotionPhase::kComplying);
  }
  void stand_held() {
    send_hold();
    cycle();
    send(OperatorKind::kStand);
    run_held(preset_.rise_time_s + 0.5);
    ASSERT_EQ(motion_.state, MotionPhase::kStanding);
    set_foot({0.0, 0.0, -preset_.stand_length_m});
    set_contact(true);
  }
};

TEST_F(HoldToRunTest, NothingIsDoneThatNobodyHolds) {
  OperatorCommand move;
  move.kind = OperatorKind::kMoveJoint;
  move.joint = 0;
  move.joint_target_rad = 0.1;
  for (const std::int64_t id : {send(OperatorKind::kStand), send(OperatorKind::kComply), send(move)}) {
    cycle();
    EXPECT_EQ(outcomes(id), "refused");
    EXPECT_EQ(last_reason(id), "maintenance mode: nobody holds; sprung hold, in another terminal");
  }
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
}

TEST_F(HoldToRunTest, StandsSlowlyWhileSomebodyHolds) {
  EXPECT_GE(preset_.rise_time_s, 4.0);
  stand_held();
  run_held(5.0);
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(HoldToRunTest, WhatStandsStaysWhereItIsWhenNobodyHoldsAnyMore) {
  stand_held();
  const Vec3 stood_m = desired().desired_foot_in_hip_m;
  run(5.0);
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
  EXPECT_EQ(desired().desired_foot_in_hip_m, stood_m);
  const std::int64_t id = send(OperatorKind::kComply);
  cycle();
  EXPECT_EQ(outcomes(id), "refused");
}

TEST_F(HoldToRunTest, WhatCompliesStandsWhenNobodyHoldsAnyMoreWhoeverRenewsItsOwnHold) {
  stand_held();
  comply_for(0.5);
  for (int i = 0; i < 6; ++i) {
    send_hold(0.5, OperatorKind::kHold);  // of the other terminal
    run(0.1);
  }
  EXPECT_NE(motion_.state, MotionPhase::kComplying);
  run_until(MotionPhase::kStanding);
  const std::int64_t late = send_hold(0.5, OperatorKind::kHold);
  cycle();
  EXPECT_EQ(last_reason(late), "nothing is held");
}

TEST_F(HoldToRunTest, WhoeverHoldsDoesNotRenewWhatAnotherTerminalHeld) {
  stand_held();
  comply_for(0.5);
  run_held(0.7);
  EXPECT_NE(motion_.state, MotionPhase::kComplying);
}

TEST_F(HoldToRunTest, JointThatMovesStopsWhenNobodyHoldsAnyMore) {
  for (std::size_t j = 0; j < 2; ++j)
    state_.joints[j].estimated_position_rad = 0.5 * (robot_.joints[j].position_min_rad +
                                                     robot_.joints[j].position_max_rad);
  send_hold();
  cycle();
  OperatorCommand move;
  move.kind = OperatorKind::kMoveJoint;
  move.joint = 0;
  move.joint_target_rad = state_.joints[0].estimated_position_rad + 0.4;
  move.joint_speed_rad_s = 0.2;
  move.joint_acceleration_rad_s2 = 2.0;
  const std::int64_t id = send(move);
  run(1.2);
  EXPECT_EQ(outcomes(id), "accepted failed") << last_reason(id);
  EXPECT_EQ(motion_.state, MotionPhase::kMovingJoint) << "held where it stopped";
}

TEST_F(HoldToRunTest, WhatRisesIsDampedWhenNobodyHoldsAnyMore) {
  send_hold();
  cycle();
  const std::int64_t id = send(OperatorKind::kStand);
  run(0.6);
  EXPECT_EQ(motion_.state, MotionPhase::kSitting);
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
  EXPECT_EQ(outcomes(id), "accepted failed");
  run(3.0);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDisabled);
}

TEST_F(HoldToRunTest, SittingDownNeedsNobody) {
  stand_held();
  const std::int64_t id = send(OperatorKind::kSit);
  run(preset_.rise_time_s + 0.1);
  EXPECT_EQ(outcomes(id), "accepted done");
}

TEST_F(HoldToRunTest, NeitherJumpsNorWalks) {
  stand_held();
  for (OperatorKind kind : {OperatorKind::kJump, OperatorKind::kLand, OperatorKind::kWalk}) {
    const std::int64_t id = send(kind);
    cycle();
    EXPECT_EQ(last_reason(id), "maintenance mode: the robot neither jumps nor walks");
  }
}

TEST_F(HoldToRunTest, WordLastsASecondAtMost) {
  for (double hold_s : {1.5, 0.0, -1.0, kNaN}) {
    const std::int64_t id = send_hold(hold_s);
    cycle();
    EXPECT_EQ(outcomes(id), "refused") << hold_s;
  }
}

TEST_F(HoldToRunTest, ParametersChangeOnlyWhileTheRobotIsOff) {
  OperatorCommand set;
  set.kind = OperatorKind::kSetParameter;
  set.parameter = parameter_id("stand_length");
  set.parameter_value = 0.95 * preset_.stand_length_m;
  std::int64_t id = send(set);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
  stand_held();
  id = send(set);
  cycle();
  EXPECT_EQ(outcomes(id), "refused");
}

}  // namespace
}  // namespace sprung
