/// `comply` from command to LEG_COMMAND.
#include "planner/leg_gains.h"
#include "tests/planner/planner_fixture.h"

namespace sprung {
namespace {

class ComplyingTest : public PlannerFixture {
 protected:
  std::int64_t send_comply(double stiffness_N_m, double damping_N_s_m = 40.0) {
    OperatorCommand command;
    command.kind = OperatorKind::kComply;
    command.stiffness_N_m = {stiffness_N_m, kNaN, stiffness_N_m};
    command.damping_N_s_m = {damping_N_s_m, kNaN, damping_N_s_m};
    command.friction_compensation = 0.9;
    return send(command);
  }
};

TEST_F(ComplyingTest, FootStaysWhereItIsDesiredOnTheSpringThatWasAskedFor) {
  stand_up();
  const Vec3 stand = desired().desired_foot_in_hip_m;
  const std::int64_t id = send_comply(2000.0);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
  EXPECT_EQ(motion_.state, MotionPhase::kComplying);
  EXPECT_EQ(desired().control_mode, ControlMode::kCompliance);
  EXPECT_EQ(desired().desired_foot_in_hip_m, stand);
  EXPECT_EQ(desired().stiffness_N_m, (Vec3{2000.0, 0.0, 2000.0}));
  EXPECT_EQ(desired().damping_N_s_m, (Vec3{40.0, 0.0, 40.0}));
  EXPECT_EQ(desired().friction_compensation, 0.9);
  run(20.0);  // no time-out
  EXPECT_EQ(motion_.state, MotionPhase::kComplying);
}

TEST_F(ComplyingTest, OtherGainsMoveNothing) {
  stand_up();
  send_comply(2000.0);
  cycle();
  const Vec3 stand = desired().desired_foot_in_hip_m;
  set_foot({0.05, 0.0, -0.42});  // pulled
  const std::int64_t id = send_comply(500.0, 10.0);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
  EXPECT_EQ(desired().desired_foot_in_hip_m, stand);
  EXPECT_EQ(desired().stiffness_N_m, (Vec3{500.0, 0.0, 500.0}));
}

TEST_F(ComplyingTest, StandsAgainWhenItsHoldIsNotRenewed) {
  stand_up();
  OperatorCommand command;
  command.kind = OperatorKind::kComply;
  command.stiffness_N_m = {2000.0, kNaN, 2000.0};
  command.damping_N_s_m = {40.0, kNaN, 40.0};
  command.friction_compensation = 0.9;
  command.hold_s = 0.8;
  const std::int64_t id = send(command);
  cycle();
  EXPECT_EQ(outcomes(id), "accepted done");
  for (int i = 0; i < 20; ++i) {  // somebody is there
    run(0.4);
    OperatorCommand renewal;
    renewal.kind = OperatorKind::kHold;
    renewal.hold_s = 0.8;
    const std::int64_t renewed = send(renewal);
    cycle();
    ASSERT_EQ(outcomes(renewed), "accepted done");
    ASSERT_EQ(motion_.state, MotionPhase::kComplying);
  }
  run(0.79);
  EXPECT_EQ(motion_.state, MotionPhase::kComplying);
  run(0.02);
  EXPECT_EQ(motion_.state, MotionPhase::kRecover);
  run_until(MotionPhase::kStanding);
  EXPECT_STREQ(motion_.last_transition, "the operator's hold was not renewed: stopped");
  const std::int64_t late = send(OperatorKind::kHold);
  cycle();
  EXPECT_EQ(outcomes(late), "refused");
}

TEST_F(ComplyingTest, StopReturnsToTheStandFromWhereTheLegReallyIs) {
  stand_up();
  send_comply(2000.0);
  cycle();
  set_foot({0.05, 0.0, -0.42});
  const std::int64_t stop = send(OperatorKind::kStop);
  run(0.002);
  EXPECT_EQ(motion_.state, MotionPhase::kRecover);
  EXPECT_EQ(desired().control_mode, ControlMode::kPosition);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.05, 0.0, -0.42}));
  run_until(MotionPhase::kStanding);
  EXPECT_EQ(outcomes(stop), "accepted done");
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.0, 0.0, -preset_.stand_length_m}));
}

TEST_F(ComplyingTest, ComplianceCanBeHadAgainAfterAStop) {
  stand_up();
  send_comply(2000.0);
  cycle();
  send(OperatorKind::kStop);
  run(0.002);
  run_until(MotionPhase::kStanding);
  send_comply(2000.0);
  run(0.1);
  EXPECT_EQ(motion_.state, MotionPhase::kComplying);  // the old stop is forgotten
}

TEST_F(ComplyingTest, SitLowersFromWhereTheLegReallyIs) {
  stand_up();
  send_comply(2000.0);
  cycle();
  set_foot({0.0, 0.0, -0.42});
  const std::int64_t sit = send(OperatorKind::kSit);
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kSitting);
  EXPECT_EQ(desired().desired_foot_in_hip_m, (Vec3{0.0, 0.0, -0.42}));
  run_until(MotionPhase::kIdle);
  EXPECT_EQ(outcomes(sit), "accepted done");
}

TEST_F(ComplyingTest, RefusalsSayWhy) {
  const std::int64_t lying = send_comply(2000.0);
  cycle();
  EXPECT_EQ(last_reason(lying), "not standing: stand first");
  stand_up();
  const std::int64_t negative = send_comply(-2000.0);
  const std::int64_t open = send(OperatorKind::kComply);
  cycle();
  EXPECT_EQ(last_reason(negative), "stiffness must be 0 to 100000 N/m");
  EXPECT_EQ(outcomes(open), "refused");
  EXPECT_EQ(motion_.state, MotionPhase::kStanding);
  send_comply(2000.0);
  cycle();
  const std::int64_t jump = send_jump(JumpMode::kHybrid);
  cycle();
  EXPECT_EQ(last_reason(jump), "busy: complying, stop first");
}

TEST_F(ComplyingTest, LostDriveEndsIt) {
  stand_up();
  send_comply(2000.0);
  cycle();
  state_.joints[1].status = JointStatus::kFault;
  cycle();
  EXPECT_EQ(motion_.state, MotionPhase::kIdle);
  EXPECT_EQ(desired().control_mode, ControlMode::kDamping);
}

TEST_F(ComplyingTest, PresetSaysHowMuchInertiaIsCompensated) {
  PresetConfig preset = preset_;
  preset.inertia_compensation = 0.7;
  DesiredLeg out;
  set_compliance(preset.hybrid_landing, 0.5, preset, out);
  EXPECT_EQ(out.inertia_compensation, 0.7);
}

}  // namespace
}  // namespace sprung
