#include "tools/lab/campaign/expected_cause.h"

#include <gtest/gtest.h>

namespace sprung::campaign {
namespace {

Injection drive_fault(FaultKind kind, double value, double duration_s) {
  Injection out;
  out.kind = kind == FaultKind::kBusOff ? Class::kBus : Class::kDrive;
  out.drive_fault = kind;
  out.value = value;
  out.duration_s = duration_s;
  return out;
}

TEST(ExpectedCause, FaultThatEverybodySeesMustBeNamedAsWhatItIs) {
  const Injection current = drive_fault(FaultKind::kOverCurrent, 0.0, 0.01);
  EXPECT_TRUE(cause_is_expected(current, SafetyCause::kDriveFault, true));
  EXPECT_FALSE(cause_is_expected(current, SafetyCause::kNone, true));
  EXPECT_FALSE(cause_is_expected(current, SafetyCause::kPlannerLost, true));
  const Injection off = drive_fault(FaultKind::kBusOff, 0.0, 0.01);
  EXPECT_TRUE(cause_is_expected(off, SafetyCause::kBusLost, true));
  EXPECT_FALSE(cause_is_expected(off, SafetyCause::kNone, true));
}

TEST(ExpectedCause, WhatIsTooSmallOrTooShortMayPass) {
  EXPECT_TRUE(cause_is_expected(drive_fault(FaultKind::kEncoderJump, 0.03, 0.1), SafetyCause::kNone, true));
  EXPECT_FALSE(cause_is_expected(drive_fault(FaultKind::kEncoderJump, -0.5, 0.1), SafetyCause::kNone, true));
  EXPECT_TRUE(cause_is_expected(drive_fault(FaultKind::kShortPdo, 0.0, 0.001), SafetyCause::kNone, true));
  EXPECT_FALSE(cause_is_expected(drive_fault(FaultKind::kShortPdo, 0.0, 0.5), SafetyCause::kNone, true));
  EXPECT_TRUE(cause_is_expected(drive_fault(FaultKind::kCurrentOffset, 1.0, 0.5), SafetyCause::kNone, true));
  EXPECT_FALSE(
      cause_is_expected(drive_fault(FaultKind::kCurrentOffset, 1.0, 0.5), SafetyCause::kDriveFault, true));
}

TEST(ExpectedCause, NothingWrongMustNameNothing) {
  EXPECT_TRUE(cause_is_expected({}, SafetyCause::kNone, true));
  EXPECT_FALSE(cause_is_expected({}, SafetyCause::kImplausible, true));
}

TEST(ExpectedCause, DeadProgramIsNamedUnlessItIsTheBridge) {
  Injection killed;
  killed.kind = Class::kProcess;
  for (const auto& [process, cause] : {std::pair{StackProcess::kController, SafetyCause::kCommandStale},
                                       std::pair{StackProcess::kEstimator, SafetyCause::kCommandStale},
                                       std::pair{StackProcess::kPlanner, SafetyCause::kPlannerLost}}) {
    killed.process = process;
    EXPECT_TRUE(cause_is_expected(killed, cause, true));
    EXPECT_FALSE(cause_is_expected(killed, SafetyCause::kNone, true));
  }
  killed.process = StackProcess::kPlanner;
  EXPECT_TRUE(cause_is_expected(killed, SafetyCause::kNone, false)) << "nobody misses it";
  killed.process = StackProcess::kBridge;
  EXPECT_TRUE(cause_is_expected(killed, SafetyCause::kNone, true));
}

TEST(ExpectedCause, StrangerWhoCommandsMustBeNamedAndOneWhoBeatsNeedNot) {
  Injection stranger;
  stranger.kind = Class::kForeign;
  stranger.foreign = Foreign::kSetpoint;
  EXPECT_TRUE(cause_is_expected(stranger, SafetyCause::kForeignMaster, true));
  EXPECT_FALSE(cause_is_expected(stranger, SafetyCause::kNone, true));
  stranger.foreign = Foreign::kHeartbeat;
  EXPECT_TRUE(cause_is_expected(stranger, SafetyCause::kNone, true));
}

}  // namespace
}  // namespace sprung::campaign
