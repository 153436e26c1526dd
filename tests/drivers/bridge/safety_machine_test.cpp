#include "drivers/bridge/safety_machine.h"

#include <gtest/gtest.h>

#include <string>

namespace sprung {
namespace {

using Level = SafetyLevel;
using Cause = SafetyCause;

Fault fault(Cause cause, const char* detail) {
  Fault result;
  result.cause = cause;
  result.actuator = 1;
  print(result.detail, "%s", detail);
  return result;
}

class SafetyMachineTest : public ::testing::Test {
 protected:
  SafetyMachineTest() { good_.armed = true; }

  void update(SafetyInputs inputs, std::int64_t after_us = 1000) {
    now_us_ += after_us;
    inputs.time_us = now_us_;
    inputs.cycle = now_us_ / 1000;
    machine_.update(inputs);
  }
  void expect(Level level, Cause cause, bool latched) const {
    EXPECT_EQ(machine_.level(), level) << name(machine_.level());
    EXPECT_EQ(machine_.cause(), cause) << name(machine_.cause());
    EXPECT_EQ(machine_.latched(), latched);
  }

  WatchdogConfig watchdogs_;
  SafetyMachine machine_{watchdogs_};
  SafetyInputs good_;
  std::int64_t now_us_ = 0;
  const Fault fault_ = fault(Cause::kDriveFault, "fault");
  const Fault bus_ = fault(Cause::kBusLost, "bus");
};

TEST_F(SafetyMachineTest, ExplanationOfAFaultIsTakenOnceAndFromTheSameDriveOnly) {
  update(good_);
  Fault first = fault(Cause::kDriveFault, "no code yet");
  first.unexplained = true;
  SafetyInputs inputs = good_;
  inputs.drive = &first;
  update(inputs);
  Fault other = fault(Cause::kDriveFault, "of another drive");
  other.actuator = 0;
  const Fault silent = fault(Cause::kDriveSilent, "another cause");
  for (const Fault* wrong : {static_cast<const Fault*>(&other), &silent}) {
    inputs.drive = wrong;
    update(inputs);
    EXPECT_STREQ(machine_.state().detail.data(), "no code yet");
  }
  const Fault explained = fault(Cause::kDriveFault, "over-current"), later = fault(Cause::kDriveFault, "x");
  for (const Fault* now : {&explained, &later}) {
    inputs.drive = now;
    update(inputs);
    EXPECT_STREQ(machine_.state().detail.data(), "over-current");
  }
  expect(Level::kDamping, Cause::kDriveFault, true);
}

TEST_F(SafetyMachineTest, StartsDisabledUntilArmed) {
  expect(Level::kDisabled, Cause::kStarting, false);
  SafetyInputs unarmed;
  update(unarmed);
  expect(Level::kDisabled, Cause::kStarting, false);
  update(good_);
  expect(Level::kOperational, Cause::kNone, false);
}

/// One row of the table in safety_machine.h: what comes into a machine that runs well, and what it must say
/// at once.
struct Row {
  const char* what;
  double command_age_s;
  bool refused;
  Cause drive;
  bool bus;
  int overruns;
  Level level;
  Cause cause;
  bool latched;
};

constexpr Row kRows[] = {
    {"all well", 0.0, false, Cause::kNone, false, 0, Level::kOperational, Cause::kNone, false},
    {"held command", 0.020, false, Cause::kNone, false, 0, Level::kOperational, Cause::kNone, false},
    {"stale command", 0.021, false, Cause::kNone, false, 0, Level::kDamping, Cause::kCommandStale, false},
    {"refused commands", 0.021, true, Cause::kNone, false, 0, Level::kDamping, Cause::kCommandRefused, false},
    {"one refused command", 0.001, true, Cause::kNone, false, 0, Level::kOperational, Cause::kNone, false},
    {"command long gone", 0.201, false, Cause::kNone, false, 0, Level::kQuickStop, Cause::kCommandStale,
     true},
    {"long refused", 0.201, true, Cause::kNone, false, 0, Level::kQuickStop, Cause::kCommandRefused, true},
    {"drive fault", 0.0, false, Cause::kDriveFault, false, 0, Level::kDamping, Cause::kDriveFault, true},
    {"silent drive", 0.0, false, Cause::kDriveSilent, false, 0, Level::kDamping, Cause::kDriveSilent, true},
    {"implausible", 0.0, false, Cause::kImplausible, false, 0, Level::kDamping, Cause::kImplausible, true},
    {"bus lost", 0.0, false, Cause::kNone, true, 0, Level::kQuickStop, Cause::kBusLost, true},
    {"bus lost and its drives", 0.0, false, Cause::kDriveSilent, true, 0, Level::kQuickStop, Cause::kBusLost,
     true},
    {"some overruns", 0.0, false, Cause::kNone, false, 9, Level::kOperational, Cause::kNone, false},
    {"too many overruns", 0.0, false, Cause::kNone, false, 10, Level::kDamping, Cause::kOverruns, false},
    {"overruns and a fault", 0.0, false, Cause::kDriveFault, false, 10, Level::kDamping, Cause::kDriveFault,
     true},
};

class EveryRow : public SafetyMachineTest, public ::testing::WithParamInterface<Row> {};

TEST_P(EveryRow, GivesItsLevelCauseAndLatchAndKeepsOnlyLatchedOnes) {
  const Row& row = GetParam();
  SCOPED_TRACE(row.what);
  const DetailText refusal{"refused"};
  const Fault drive = fault(row.drive, "drive");
  update(good_);
  SafetyInputs inputs = good_;
  inputs.command_age_s = row.command_age_s;
  inputs.command_refused = row.refused;
  inputs.refusal = &refusal;
  inputs.drive = row.drive == Cause::kNone ? nullptr : &drive;
  inputs.bus = row.bus ? &bus_ : nullptr;
  inputs.overruns_in_row = row.overruns;
  update(inputs);
  expect(row.level, row.cause, row.latched);
  EXPECT_EQ(machine_.state().since_seq, row.cause == Cause::kNone ? 1 : 2);
  update(good_);
  if (row.latched) {
    expect(row.level, row.cause, true);
  } else {
    expect(Level::kOperational, Cause::kNone, false);
  }
}

INSTANTIATE_TEST_SUITE_P(Design8, EveryRow, ::testing::ValuesIn(kRows));

TEST_F(SafetyMachineTest, FaultDampsUntilTheJointsHaveRestedAndKeepsItsCause) {
  update(good_);
  SafetyInputs inputs = good_;
  inputs.drive = &fault_;
  update(inputs);
  update(good_, 2'000'000);
  expect(Level::kDamping, Cause::kDriveFault, true);
  good_.slow = true;
  update(good_, 299'000);
  expect(Level::kDamping, Cause::kDriveFault, true);
  update(good_, 1'000);
  expect(Level::kQuickStop, Cause::kDriveFault, true);
  EXPECT_EQ(machine_.state().actuator, 1);
  EXPECT_EQ(machine_.state().since_seq, 2);
}

TEST_F(SafetyMachineTest, ExpiredCommandDampsHoweverYoungItIs) {
  update(good_);
  SafetyInputs inputs = good_;
  inputs.command_age_s = 0.001;
  inputs.command_expired = true;
  update(inputs);
  expect(Level::kDamping, Cause::kCommandStale, false);
  update(good_);
  expect(Level::kOperational, Cause::kNone, false);
}

TEST_F(SafetyMachineTest, WhatWasNotLatchedStaysInTheDetailUntilItIsForgotten) {
  const auto detail = [this] { return std::string(machine_.state().detail.data()); };
  update(good_);
  EXPECT_EQ(detail(), "");
  SafetyInputs late = good_;
  for (const double age_s : {0.041, 0.071}) {
    late.command_age_s = age_s;
    update(late);
  }
  EXPECT_EQ(detail(), "no good DRIVE_COMMAND for 71 ms");
  update(good_);
  expect(Level::kOperational, Cause::kNone, false);
  EXPECT_EQ(detail(), "was damping in cycle 2, command stale: no good DRIVE_COMMAND for 71 ms");
  update(good_);
  EXPECT_EQ(detail(), "was damping in cycle 2, command stale: no good DRIVE_COMMAND for 71 ms");
  machine_.forget_past();
  update(good_);
  EXPECT_EQ(detail(), "");
  update(late);
  update(good_);
  machine_.clear(now_us_, 9);
  update(good_);
  EXPECT_EQ(detail(), "") << "forgotten with the latched ones";
}

TEST_F(SafetyMachineTest, FaultNeverLiftsADisabledRobotToDamping) {
  SafetyInputs inputs;
  inputs.drive = &fault_;
  update(inputs);
  expect(Level::kDisabled, Cause::kDriveFault, true);
}

TEST_F(SafetyMachineTest, BusLostWhileDampingBringsItsOwnCause) {
  update(good_);
  SafetyInputs inputs = good_;
  inputs.drive = &fault_;
  update(inputs);
  inputs.drive = nullptr;
  inputs.bus = &bus_;
  update(inputs);
  expect(Level::kQuickStop, Cause::kBusLost, true);
}

TEST_F(SafetyMachineTest, EmergencyStopWinsOverEverythingAndIsKept) {
  SafetyInputs inputs = good_;
  inputs.bus = &bus_;
  update(inputs);
  machine_.emergency_stop(now_us_, 1);
  expect(Level::kDisabled, Cause::kEmergencyStop, true);
  update(inputs);
  expect(Level::kDisabled, Cause::kEmergencyStop, true);
}

TEST_F(SafetyMachineTest, ClearLeadsToDisabledNotToOperational) {
  machine_.emergency_stop(0, -1);
  machine_.clear(now_us_, 1);
  expect(Level::kDisabled, Cause::kStarting, false);
  SafetyInputs unarmed;
  update(unarmed);
  expect(Level::kDisabled, Cause::kStarting, false);
}

TEST_F(SafetyMachineTest, RefusedDriveDoesNotHideAnEmergencyStop) {
  machine_.emergency_stop(0, -1);
  machine_.refuse_drive(fault(Cause::kDriveRefused, "refused"), 0, -1);
  expect(Level::kDisabled, Cause::kEmergencyStop, true);
}

TEST_F(SafetyMachineTest, FaultDampsAtMostFiveSeconds) {
  update(good_);
  SafetyInputs inputs = good_;
  inputs.drive = &fault_;
  update(inputs);
  update(good_, 4'999'000);
  expect(Level::kDamping, Cause::kDriveFault, true);
  update(good_, 1'000);
  expect(Level::kQuickStop, Cause::kDriveFault, true);
}

TEST_F(SafetyMachineTest, ShutdownOfAStandingRobotDampsForThreeTenthsOfASecond) {
  update(good_);
  machine_.begin_shutdown(now_us_, 1);
  SafetyInputs slow = good_;
  slow.slow = true;
  update(slow);  // it stands, and only now begins to sink
  expect(Level::kDamping, Cause::kShutdown, true);
  update(slow, 298'000);
  expect(Level::kDamping, Cause::kShutdown, true);
  update(slow, 1'000);
  expect(Level::kDisabled, Cause::kShutdown, true);
}

TEST_F(SafetyMachineTest, ShutdownDampsUntilSlowForThreeTenthsOfASecond) {
  update(good_);
  machine_.begin_shutdown(now_us_, 1);
  SafetyInputs slow = good_;
  slow.slow = true;
  update(slow, 200'000);
  update(good_, 100'000);  // sinks
  update(slow, 1'000);
  update(slow, 298'000);
  expect(Level::kDamping, Cause::kShutdown, true);
  update(slow, 1'000);
  expect(Level::kDisabled, Cause::kShutdown, true);
}

TEST_F(SafetyMachineTest, ShutdownDampsAtMostOneSecond) {
  update(good_);
  machine_.begin_shutdown(now_us_, 1);
  SafetyInputs slow = good_;
  slow.slow = true;
  update(good_, 900'000);
  update(slow, 99'000);
  expect(Level::kDamping, Cause::kShutdown, true);
  update(slow, 1'000);
  expect(Level::kDisabled, Cause::kShutdown, true);
}

TEST_F(SafetyMachineTest, ShutdownLeavesAStopUnderWayAlone) {
  update(good_);
  SafetyInputs inputs = good_;
  inputs.bus = &bus_;
  update(inputs);
  machine_.begin_shutdown(now_us_, 1);
  expect(Level::kQuickStop, Cause::kBusLost, true);
}

}  // namespace
}  // namespace sprung
