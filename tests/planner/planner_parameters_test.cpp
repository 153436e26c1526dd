/// Parameters from an operator's word to LEG_COMMAND.
#include "planner/parameter_settings.h"
#include "robots/parameters.h"
#include "tests/planner/walking_planner.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

class PlannerParameters : public WalkingPlanner {
 protected:
  static OperatorCommand order(const std::string& name, double value) {
    OperatorCommand out;
    out.kind = OperatorKind::kSetParameter;
    out.parameter = parameter_id(name);
    out.parameter_value = value;
    return out;
  }
  OperatorReply set(const std::string& name, double value) { return send(order(name, value)); }
  OperatorReply read(std::int64_t behind) {
    OperatorCommand question;
    question.kind = OperatorKind::kReadParameter;
    question.parameter = behind;
    return send(question);
  }
  double height_m() const { return -legs_.legs[0].desired_foot_in_hip_m[2]; }
};

TEST_F(PlannerParameters, AnswerNamesTheCycleAndTheValue) {
  const OperatorReply reply = set("compliance.stiffness.z", 4000.0);
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_EQ(reply.took_effect_at_seq, state_.stamp.seq);
  EXPECT_EQ(reply.parameter_value, 4000.0);
  const OperatorReply found = read(0);
  EXPECT_EQ(found.parameter, reply.parameter);
  EXPECT_EQ(found.parameter_value, 4000.0);
  EXPECT_EQ(read(found.parameter).parameter, 0);
  EXPECT_EQ(read(12345).outcome, OperatorOutcome::kRefused);
}

TEST_F(PlannerParameters, WhatIsBeyondItsRangeIsRefusedAndNothingChanges) {
  stand_up();
  const std::string before = motion_.last_transition;
  EXPECT_EQ(set("stand_length", 0.9).outcome, OperatorOutcome::kRefused);
  EXPECT_EQ(motion_.last_transition, before);
  EXPECT_EQ(read(0).parameter, 0);
}

TEST_F(PlannerParameters, ComplianceThatIsUnderWayGetsItWithoutAStep) {
  stand_up();
  EXPECT_EQ(send(OperatorKind::kComply).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(legs_.legs[2].stiffness_N_m[2], 3000.0);
  set("compliance.stiffness.z", 6000.0);
  for (double last = 3000.0; legs_.legs[2].stiffness_N_m[2] < 6000.0; last = legs_.legs[2].stiffness_N_m[2]) {
    cycle();
    ASSERT_LE(legs_.legs[2].stiffness_N_m[2] - last, 3000.0 * 0.002 / ParameterSettings::kRamp_s + 1e-6);
    ASSERT_GE(legs_.legs[2].stiffness_N_m[2], last);
  }
}

TEST_F(PlannerParameters, WhatComplianceWasAskedForStays) {
  stand_up();
  OperatorCommand comply;
  comply.kind = OperatorKind::kComply;
  comply.stiffness_N_m = {500.0, 500.0, 2000.0};
  send(comply);
  set("compliance.stiffness.z", 6000.0);
  set("compliance.damping.z", 200.0);
  run(1.1);
  EXPECT_EQ(legs_.legs[0].stiffness_N_m[2], 2000.0);
  EXPECT_EQ(legs_.legs[0].damping_N_s_m[2], 200.0);
}

TEST_F(PlannerParameters, RobotThatStandsGoesToItsNewHeightSlowly) {
  stand_up();
  EXPECT_NEAR(height_m(), 0.525, 1e-9);
  set("stand_length", 0.475);
  double fastest_m_s = 0.0, last_m = height_m();
  for (int k = 0; k < 600; ++k, last_m = height_m()) {
    cycle();
    fastest_m_s = std::max(fastest_m_s, std::abs(height_m() - last_m) / 0.002);
  }
  EXPECT_NEAR(height_m(), 0.475, 1e-9);
  EXPECT_LT(fastest_m_s, 0.12);
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
}

TEST_F(PlannerParameters, WalkThatIsTooFastForANewLimitSlowsDown) {
  stand_up();
  EXPECT_EQ(walk(kTrot, {0.4, 0.0, 0.0}).outcome, OperatorOutcome::kDone);
  run(4.0);
  EXPECT_NEAR(motion_.desired_speed[0], 0.4, 1e-9);
  set("gaits.trot.fastest.forward", 0.2);
  run(3.0);
  EXPECT_NEAR(motion_.desired_speed[0], 0.2, 1e-9);
  EXPECT_EQ(walk(kTrot, {0.3, 0.0, 0.0}).outcome, OperatorOutcome::kRefused);
  set("gaits.trot.fastest.forward", 0.4);
  run(3.0);
  EXPECT_NEAR(motion_.desired_speed[0], 0.4, 1e-9) << "as it was asked for";
}

TEST_F(PlannerParameters, WalkThatWasStoppedStaysSo) {
  stand_up();
  walk(kTrot, {0.2, 0.0, 0.0});
  run(2.0);
  send(OperatorKind::kStop);
  set("gaits.trot.fastest.forward", 0.1);
  run_until(MotionPhase::kStanding);
}

TEST_F(PlannerParameters, GainsOfStandingFeetChangeWhileItWalks) {
  stand_up();
  walk(kTrot, {0.2, 0.0, 0.0});
  run(1.0);
  set("walk.stance.stiffness.z", 3000.0);
  run(1.5);
  const auto compliant = [](const DesiredLeg& leg) { return leg.control_mode == ControlMode::kCompliance; };
  EXPECT_GE(std::count_if(legs_.legs.begin(), legs_.legs.end(), compliant), 2);
  for (const DesiredLeg& leg : legs_.legs) {
    if (compliant(leg)) {
      EXPECT_EQ(leg.stiffness_N_m[2], 3000.0);
    }
  }
}

TEST_F(PlannerParameters, NothingIsAllocatedWhileTheyChange) {
  stand_up();
  walk(kTrot, {0.2, 0.0, 0.0});
  run(1.0);
  OperatorCommand one = order("walk.stance.stiffness.z", 3000.0);
  one.request_id = 1000;
  ASSERT_TRUE(planner_.submit(one));
  for (int k = 0; k < 700; ++k) {
    state_.stamp.utime_us += 2000;
    ++state_.stamp.seq;
    const std::int64_t before = test::allocation_count();
    planner_.step(state_, legs_, motion_);
    for (OperatorReply reply; planner_.next_reply(reply);) continue;
    ASSERT_EQ(test::allocation_count(), before) << k;
  }
}

}  // namespace
}  // namespace sprung
