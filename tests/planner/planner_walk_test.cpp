/// `walk` from command to LEG_COMMAND: the planner of pegasus, its feet where they are wanted, and falls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "planner/motion.h"
#include "tests/planner/walking_planner.h"

namespace sprung {
namespace {

class PlannerWalkTest : public WalkingPlanner {};

TEST_F(PlannerWalkTest, HoldThatIsNotRenewedSlowsDownAndEndsInAStand) {
  for (const int gait : {kCrawl, kTrot}) {
    SCOPED_TRACE(gait);
    stand_up();
    OperatorCommand order;
    order.kind = OperatorKind::kWalk;
    order.gait = gait;
    order.walk_speed = {0.1, 0.0, 0.0};
    order.hold_s = 0.8;
    EXPECT_EQ(send(order).outcome, OperatorOutcome::kDone);
    run(0.7);
    EXPECT_EQ(motion_.state, MotionPhase::kWalking);
    OperatorCommand renewal;
    renewal.kind = OperatorKind::kHold;
    renewal.hold_s = 0.8;
    EXPECT_EQ(send(renewal).outcome, OperatorOutcome::kDone);
    run(0.7);
    EXPECT_EQ(motion_.state, MotionPhase::kWalking) << "it was renewed";
    run(0.1 + 0.1 / robot_.preset("best").walk.acceleration_m_s2);
    run(0.2);
    EXPECT_EQ(motion_.desired_speed, (Vec3{0.0, 0.0, 0.0}));
    run_until(MotionPhase::kStanding);
    EXPECT_STREQ(motion_.last_transition, "the operator's hold was not renewed: stopped");
  }
}

TEST_F(PlannerWalkTest, HaltedCrawlStandsOnItsFeetWhereTheyAreUntilItSits) {
  stand_up();
  OperatorCommand order;
  order.kind = OperatorKind::kWalk;
  order.gait = kCrawl;
  order.walk_speed = {0.1, 0.0, 0.0};
  order.hold_s = 6.0;
  send(order);
  run(6.0);
  run_until(MotionPhase::kRecover);
  std::vector<Vec3> at_m;
  for (const EstimatedLeg& leg : state_.legs) at_m.push_back(leg.estimated_foot_in_hip_m);
  run_until(MotionPhase::kStanding);
  double furthest_m = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(legs_.legs[i].desired_foot_in_hip_m[axis], at_m[i][axis], 1e-3) << i;
    furthest_m = std::max(furthest_m, std::abs(at_m[i][0]));
  }
  EXPECT_GT(furthest_m, 0.05) << "else this shows nothing";
  send(OperatorKind::kSit);
  run(1.9);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(legs_.legs[i].desired_foot_in_hip_m[0], 0.0, 1e-3);
}

TEST_F(PlannerWalkTest, WalkWithoutAHoldGoesOnAndAHoldThatCannotBeIsRefused) {
  stand_up();
  OperatorCommand order;
  order.kind = OperatorKind::kWalk;
  order.gait = kTrot;
  order.hold_s = -1.0;
  EXPECT_STREQ(send(order).reason, "a hold lasts more than 0 s and at most 3600 s");
  walk(kTrot);
  run(10.0);
  EXPECT_EQ(motion_.state, MotionPhase::kWalking);
  EXPECT_STREQ(send(OperatorKind::kHold).reason, "nothing is held");
}

TEST_F(PlannerWalkTest, StandsUpWithItsFeetBesideItsHips) {
  stand_up();
  const double width_m = 0.08 + robot_.preset("best").walk.stance_width_m;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(legs_.legs[i].desired_foot_in_hip_m[1], i % 2 == 0 ? width_m : -width_m, 1e-9);
    EXPECT_NEAR(legs_.legs[i].desired_foot_in_hip_m[2], -robot_.preset("best").stand_length_m, 1e-9);
  }
}

TEST_F(PlannerWalkTest, WalkIsDoneAsSoonAsItIsAcceptedAndLastsUntilStop) {
  stand_up();
  const OperatorReply reply = walk(kTrot, {0.3, 0.0, 0.0});
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(reply.reason, "walk requested");
  EXPECT_EQ(motion_.state, MotionPhase::kWalking);
  EXPECT_EQ(motion_.gait, kTrot);
  run(5.0);
  EXPECT_EQ(motion_.state, MotionPhase::kWalking);
  EXPECT_DOUBLE_EQ(motion_.desired_speed[0], 0.3);
  const std::int64_t stop = (send(OperatorKind::kStop), last_id_);
  EXPECT_EQ(answer(stop).outcome, OperatorOutcome::kAccepted);
  run_until(MotionPhase::kRecover);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(answer(stop).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(motion_.last_transition, "stand reached again");
  EXPECT_EQ(motion_.gait, -1);
}

TEST_F(PlannerWalkTest, FeetAreWantedWithoutAStepFromStandingOverWalkingToStanding) {
  stand_up();
  LegCommand before = legs_;
  const auto watch = [&](double seconds) {
    for (int k = 0; k < static_cast<int>(seconds / 0.002); ++k) {
      cycle();
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_LT(std::abs(legs_.legs[i].desired_foot_in_hip_m[axis] -
                             before.legs[i].desired_foot_in_hip_m[axis]),
                    5e-3)
              << name(motion_.state) << " leg " << i << " axis " << axis;
      before = legs_;
    }
  };
  walk(kTrot, {0.3, 0.0, 0.2});
  watch(4.0);
  send(OperatorKind::kStop);
  watch(6.0);
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(PlannerWalkTest, LegsShowTheirOwnPhasesAndEvents) {
  stand_up();
  walk(kTrot);
  std::array<bool, 3> seen{};
  for (int k = 0; k < 500; ++k) {
    cycle();
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(motion_.legs[i].phase, legs_.legs[i].phase);
      const int n = static_cast<int>(motion_.legs[i].phase) - static_cast<int>(LegPhase::kSwing);
      ASSERT_TRUE(n >= 0 && n < 3) << name(motion_.legs[i].phase);
      seen[n] = true;
    }
  }
  EXPECT_EQ(seen, (std::array<bool, 3>{true, true, true}));
}

TEST_F(PlannerWalkTest, AnotherWalkChangesTheOneThatIsWalked) {
  stand_up();
  walk(kTrot, {0.1, 0.0, 0.0});
  run(2.0);
  const OperatorReply faster = walk(kTrot, {0.3, 0.0, 0.0});
  EXPECT_EQ(faster.outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(faster.reason, "other gait or speed requested");
  EXPECT_EQ(walk(kStand).outcome, OperatorOutcome::kDone);
  run(2.0);
  EXPECT_EQ(motion_.gait, kStand);
  EXPECT_EQ(walk(kTrot, {0.1, 0.0, 0.0}).outcome, OperatorOutcome::kDone);
}

TEST_F(PlannerWalkTest, RefusalsSayWhy) {
  EXPECT_STREQ(walk(kTrot).reason, "not standing: stand first");
  stand_up();
  EXPECT_STREQ(walk(7).reason, "unknown gait");
  EXPECT_STREQ(walk(kTrot, {2.0, 0.0, 0.0}).reason, "faster forward than this gait goes");
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
  EXPECT_STREQ(motion_.last_transition, "faster forward than this gait goes");
  walk(kTrot);
  EXPECT_STREQ(walk(kCrawl).reason, "no transition between these gaits: stop first");
  EXPECT_STREQ(send(OperatorKind::kSit).reason, "busy: walking, stop first");
  EXPECT_STREQ(send(OperatorKind::kComply).reason, "busy: walking, stop first");
  EXPECT_STREQ(send(OperatorKind::kStand).reason, "busy: walking, stop first");
  send(OperatorKind::kStop);
  EXPECT_STREQ(walk(kTrot).reason, "already stopping");
  EXPECT_STREQ(send(OperatorKind::kStop).reason, "already stopping");
}

TEST_F(PlannerWalkTest, RobotThatOnlyWalksRefusesToJumpAndLand) {
  stand_up();
  EXPECT_EQ(send(OperatorKind::kJump).outcome, OperatorOutcome::kRefused);
  EXPECT_STREQ(send(OperatorKind::kLand).reason, "this preset has no landing: the robot does not jump");
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(PlannerWalkTest, NoGroundEndsTheWalkAndTheOperatorSeesWhyUntilSomethingElseIsAsked) {
  stand_up();
  walk(kTrot);
  hole_ = 2;
  run_until(MotionPhase::kRecover);
  EXPECT_STREQ(motion_.last_transition, "a foot found no ground");
  run_until(MotionPhase::kStanding);
  run(1.0);
  EXPECT_STREQ(motion_.last_transition, "a foot found no ground");
  hole_ = 99;
  EXPECT_EQ(walk(kTrot).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(motion_.last_transition, "walk requested");
  send(OperatorKind::kStop);
  run_until(MotionPhase::kStanding);
  EXPECT_STREQ(motion_.last_transition, "stand reached again");
}

TEST_F(PlannerWalkTest, WalkThatFailsRefusesAnotherWithItsReasonAndAStopIsDone) {
  stand_up();
  walk(kTrot, {0.3, 0.0, 0.0});
  run(2.0);
  hole_ = 2;
  while (std::string(motion_.last_transition) != "a foot found no ground") cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kWalking);
  EXPECT_STREQ(walk(kTrot).reason, "a foot found no ground");
  const std::int64_t stop = (send(OperatorKind::kStop), last_id_);
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(answer(stop).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(answer(stop).reason, "a foot found no ground");
}

TEST_F(PlannerWalkTest, FallIsDampedForASecondAndThenOff) {
  for (const bool walking : {false, true}) {
    stand_up();
    if (walking) walk(kTrot, {0.3, 0.0, 0.0});
    run(0.5);
    tilt(0.8);
    cycle();
    EXPECT_EQ(motion_.state, MotionPhase::kFallen);
    EXPECT_STREQ(motion_.last_transition, "a fall was detected: legs are damped");
    EXPECT_TRUE(every_leg(ControlMode::kDamping));
    EXPECT_STREQ(walk(kTrot).reason, "busy: fallen, legs are let down");
    run(kSinkTime_s - 0.01);
    EXPECT_TRUE(every_leg(ControlMode::kDamping));
    run(0.02);
    EXPECT_EQ(motion_.state, MotionPhase::kIdle);
    EXPECT_TRUE(every_leg(ControlMode::kDisabled));
    tilt(0.0);
    run(1.0);
  }
}

TEST_F(PlannerWalkTest, FallThatComesIsMetWithFoldedLegsThenDampedThenOff) {
  stand_up();
  walk(kStand);
  run(0.5);
  tilt(0.2);
  state_.body.uses_imu = true;
  state_.body.estimated_velocity_m_s = {0.0, 3.0, 0.0};
  state_.body.estimated_height_m = 0.5;
  const auto on = [this](double duration_s) {
    for (double t_s = 0.0; t_s < duration_s; t_s += 0.002) {
      state_.stamp.utime_us += 2000;
      ++state_.stamp.seq;
      planner_.step(state_, legs_, motion_);
    }
  };
  on(0.02);
  ASSERT_EQ(motion_.state, MotionPhase::kFallen);
  EXPECT_STREQ(motion_.last_transition, "a fall is coming: legs fold and spring");
  EXPECT_TRUE(every_leg(ControlMode::kCompliance));
  on(FallReflex::kLasts_s + 0.02);
  EXPECT_EQ(motion_.state, MotionPhase::kFallen);
  EXPECT_TRUE(every_leg(ControlMode::kDamping));
  on(kSinkTime_s);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
}

TEST_F(PlannerWalkTest, HipsThatSinkToTheFeetAreAFallToo) {
  stand_up();
  walk(kStand);
  state_.body.estimated_height_m = 0.2;
  state_.stamp.utime_us += 2000;
  ++state_.stamp.seq;
  planner_.step(state_, legs_, motion_);
  EXPECT_EQ(motion_.state, MotionPhase::kFallen);
}

TEST_F(PlannerWalkTest, RisingAndSittingAreLowAndNoFall) {
  state_.body.estimated_height_m = 0.1;
  stand_up();
  send(OperatorKind::kSit);
  run_until(MotionPhase::kIdle);
  EXPECT_STREQ(motion_.last_transition, "sat down, drives off");
}

TEST_F(PlannerWalkTest, FallenRobotGetsUpFromLyingFlatButNotFromItsSide) {
  tilt(1.5);
  EXPECT_STREQ(send(OperatorKind::kStand).reason, "lying on its side or back: turn it over");
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  tilt(0.1);
  stand_up();
}

TEST_F(PlannerWalkTest, StopThatWaitsFailsWithTheFall) {
  stand_up();
  walk(kTrot, {0.3, 0.0, 0.0});
  run(2.0);
  const std::int64_t stop = (send(OperatorKind::kStop), last_id_);
  tilt(-0.9);
  run(1.1);
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(answer(stop).outcome, OperatorOutcome::kFailed);
}

TEST_F(PlannerWalkTest, LostDriveOrSafetyEndsTheWalkDamped) {
  for (const bool drive : {true, false}) {
    stand_up();
    walk(kTrot, {0.2, 0.0, 0.0});
    run(1.0);
    if (drive) {
      state_.joints[7].drive_enabled = false;
    } else {
      state_.safety = SafetyLevel::kDamping;
    }
    cycle();
    EXPECT_EQ(motion_.state, MotionPhase::kIdle);
    EXPECT_TRUE(every_leg(ControlMode::kDamping));
    state_.joints[7].drive_enabled = true;
    state_.safety = SafetyLevel::kOperational;
    run(1.5);
    EXPECT_TRUE(every_leg(ControlMode::kDisabled));
  }
}

}  // namespace
}  // namespace sprung
