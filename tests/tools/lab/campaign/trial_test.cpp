#include "tools/lab/campaign/trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

Draw drawn(const std::string& state, const Injection& injection) {
  Draw out;
  out.state = state;
  out.injections = {injection};
  out.injections[0].at_seq = 0;
  return out;
}

Injection drive_fault(FaultKind kind, double value = 0.0) {
  Injection out;
  out.kind = Class::kDrive;
  out.drive_fault = kind;
  out.value = value;
  out.target = 1;
  out.duration_s = 0.3;
  return out;
}

Injection killed(StackProcess process) {
  Injection out;
  out.kind = Class::kProcess;
  out.process = process;
  return out;
}

class TrialTest : public testing::Test {
 protected:
  const RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(TrialTest, NothingWrongIsNeverStoppedInAnyState) {
  for (const std::string& state : states_of(robot_)) {
    const Verdict verdict = run_trial(robot_, "best", drawn(state, {}));
    EXPECT_EQ(verdict.failure, "") << state;
    EXPECT_FALSE(verdict.tripped()) << state << ": " << name(verdict.cause);
    EXPECT_TRUE(verdict.breaches.empty()) << state;
    EXPECT_TRUE(verdict.recovered) << state << ": " << verdict.explained;
  }
}

TEST_F(TrialTest, FaultIsNoticedMadeSafeAndRecoveredFrom) {
  const Verdict verdict = run_trial(robot_, "best", drawn("thrust", drive_fault(FaultKind::kOverCurrent)));
  EXPECT_EQ(verdict.failure, "");
  EXPECT_EQ(verdict.cause, SafetyCause::kDriveFault);
  EXPECT_TRUE(verdict.cause_expected);
  EXPECT_LE(verdict.noticed_s, 0.01);
  EXPECT_GT(verdict.safe_s, 0.0);
  EXPECT_TRUE(verdict.recovered) << verdict.explained;
  EXPECT_TRUE(verdict.breaches.empty());
}

TEST_F(TrialTest, ScriptHasTheCommandsAndFaultsOfItsRun) {
  const Draw draw = drawn("thrust", drive_fault(FaultKind::kOverCurrent));
  ASSERT_TRUE(has_script(draw));
  const ScriptedTrial trial = script_of(robot_, "best", draw);
  ASSERT_EQ(trial.script.commands.size(), 2u);
  EXPECT_EQ(trial.script.commands[0].kind, OperatorKind::kStand);
  EXPECT_EQ(trial.script.commands[1].kind, OperatorKind::kJump);
  ASSERT_EQ(trial.script.controls.size(), 1u);
  EXPECT_EQ(trial.script.controls[0].fault, FaultKind::kOverCurrent);
  EXPECT_EQ(trial.end.stamp.seq, trial.script.cycles - 1);
}

TEST_F(TrialTest, RunThatAsksTheBridgeOrTouchesMessagesHasNone) {
  EXPECT_FALSE(has_script(drawn("clearing", drive_fault(FaultKind::kOverCurrent))));
  Injection lost;
  lost.kind = Class::kMessage;
  EXPECT_FALSE(has_script(drawn("standing", lost)));
  EXPECT_THROW(script_of(robot_, "best", drawn("standing", lost)), std::invalid_argument);
}

TEST_F(TrialTest, DeadProgramIsExplained) {
  const Verdict verdict = run_trial(robot_, "best", drawn("standing", killed(StackProcess::kController)));
  EXPECT_EQ(verdict.cause, SafetyCause::kCommandStale);
  EXPECT_FALSE(verdict.recovered);
  EXPECT_TRUE(verdict.back_or_explained());
}

TEST_F(TrialTest, BridgeThatDiesWhileItClearsIsExplained) {
  Draw draw = drawn("standing", {});
  draw.injections.push_back(killed(StackProcess::kBridge));
  draw.second_while_clearing = true;
  const Verdict verdict = run_trial(robot_, "best", draw);
  EXPECT_FALSE(verdict.recovered);
  EXPECT_EQ(verdict.explained, "a program is gone");
}

TEST_F(TrialTest, PlannerThatDiesWhileNothingHasPowerIsNotMissed) {
  const Verdict verdict = run_trial(robot_, "best", drawn("clearing", killed(StackProcess::kPlanner)));
  EXPECT_EQ(verdict.cause, SafetyCause::kNone);
  EXPECT_TRUE(verdict.cause_expected);
}

TEST_F(TrialTest, StrangerWhoStopsADriveIsNamed) {
  Injection stranger;
  stranger.kind = Class::kForeign;
  stranger.foreign = Foreign::kPreOperational;
  stranger.duration_s = robot_.cycle_s;
  const Verdict verdict = run_trial(robot_, "best", drawn("standing", stranger));
  EXPECT_EQ(verdict.cause, SafetyCause::kForeignMaster);
  EXPECT_TRUE(verdict.breaches.empty());
}

TEST_F(TrialTest, DeadBridgeNamesNothingAndItsDrivesLetGo) {
  const Verdict verdict = run_trial(robot_, "best", drawn("thrust", killed(StackProcess::kBridge)));
  EXPECT_TRUE(verdict.cause_expected);
  EXPECT_LE(verdict.safe_s, 0.06);
  EXPECT_TRUE(verdict.breaches.empty());
}

TEST_F(TrialTest, WrongFileThatTheBridgeItselfRefusesIsExplained) {
  Injection wrong;
  wrong.kind = Class::kFile;
  wrong.mistake = FileMistake::kRatio;
  wrong.value = 0.5;
  const Verdict verdict = run_trial(load_robot("pegasus"), "best", drawn("standing", wrong));
  EXPECT_EQ(verdict.failure, "");
  EXPECT_TRUE(verdict.cause_expected);
  EXPECT_NE(verdict.explained.find("torque_limit needs"), std::string::npos) << verdict.explained;
  EXPECT_TRUE(std::isnan(verdict.safe_s)) << "it never had power";
}

TEST_F(TrialTest, StateThatCannotBeReachedIsAFailureOfTheRun) {
  EXPECT_NE(run_trial(robot_, "best", drawn("trot", {})).failure, "");
}

}  // namespace
}  // namespace sprung::campaign
