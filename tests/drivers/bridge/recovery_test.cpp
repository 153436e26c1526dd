// `sprung clear` brings the robot back without a new process, in the order of facts canopen 2.5, and says
// what it did.
#include "drivers/bridge/recovery.h"

#include <gmock/gmock.h>

#include "drivers/canopen/objects.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using BridgeRecovery = test::PoweredBridge;

TEST_F(BridgeRecovery, ClearIsAcceptedAtOnceAndDoneWhenItIsDone) {
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  EXPECT_TRUE(latched());
  EXPECT_TRUE(bench_.bridge->bus_state().recovering);
  OperatorReply reply;
  for (int i = 0; i < 20 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_FALSE(bench_.bridge->next_reply(reply)) << "once";
  EXPECT_FALSE(latched());
  EXPECT_FALSE(bench_.bridge->bus_state().recovering);
  EXPECT_EQ(recovery(0), "nothing to do");
}

TEST_F(BridgeRecovery, ClearNeedsADisabledCommandBeforeTorqueComesBack) {
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  bench_.command_all(DriveMode::kTorque, 5.0);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  expect_stays_off();
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeRecovery, DisabledCommandOfBeforeTheClearDoesNotArm) {
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  bench_.mute_commands = true;  // they come too late for their cycle, and before the next
  bench_.command_all(DriveMode::kDisabled);
  bench_.tick();
  ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  OperatorReply reply;
  for (int i = 0; i < 20 && !bench_.bridge->next_reply(reply); ++i) {
    bench_.command.stamp = bench_.state.stamp;
    bench_.command.valid_until_utime_us = bench_.time_us + 21000;
    EXPECT_TRUE(bench_.bridge->command(bench_.command, bench_.time_us));
    bench_.tick();
  }
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  bench_.mute_commands = false;
  expect_stays_off();
}

TEST_F(BridgeRecovery, ClearOfARobotInOperationDisturbsNothing) {
  bench_.command_all(DriveMode::kTorque, 5.0);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  bench_.run(50);
  EXPECT_EQ(enabled(), 2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeRecovery, RepeatedClearIsAnsweredButNotExecutedAgain) {
  bench_.ask(OperatorKind::kEstop);
  OperatorCommand clear;
  clear.kind = OperatorKind::kClear;
  clear.request_id = 77;
  EXPECT_EQ(bench_.bridge->operator_command(clear, bench_.time_us).outcome, OperatorOutcome::kAccepted);
  bench_.run(20);
  bench_.ask(OperatorKind::kEstop);
  bench_.run(5);
  EXPECT_EQ(bench_.bridge->operator_command(clear, bench_.time_us).outcome, OperatorOutcome::kDone);
  bench_.run(20);
  EXPECT_TRUE(latched()) << "the old request cleared a newer stop";
}

TEST_F(BridgeRecovery, SecondClearWhileOneIsUnderWayIsRefused) {
  bench_.drives[0].dead = true;
  bench_.run(900);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.run(10);
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "a clear is already under way");
}

TEST_F(BridgeRecovery, WaitsUntilTheDrivesHaveStopped) {
  bench_.drives[1].lose_power();
  bench_.run(50);
  ASSERT_EQ(powered(), 1) << "the healthy one damps";
  ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.run(100);
  EXPECT_TRUE(latched());
  OperatorReply reply;
  for (int i = 0; i < 1000 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_EQ(powered(), 0);
}

TEST_F(BridgeRecovery, EmergencyStopEndsAClearUnderWay) {
  bench_.drives[0].dead = true;
  bench_.run(900);
  bench_.ask(OperatorKind::kClear);
  bench_.run(10);
  bench_.ask(OperatorKind::kEstop);
  bench_.tick();
  OperatorReply reply;
  ASSERT_TRUE(bench_.bridge->next_reply(reply));
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
  EXPECT_STREQ(reply.reason, "emergency stop");
  EXPECT_EQ(cause(), SafetyCause::kEmergencyStop);
}

TEST_F(BridgeRecovery, IsRefusedWhileNobodyCommands) {
  bench_.mute_commands = true;
  bench_.run(800);
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "no good DRIVE_COMMAND is coming in");
  bench_.mute_commands = false;
  bench_.run(2);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
}

TEST_F(BridgeRecovery, ResetsTheFaultOfOneDriveAndLeavesTheOtherAlone) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.run(900);
  ASSERT_EQ(bench_.drives[1].power, PowerState::kFault);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kSwitchOnDisabled);
  EXPECT_EQ(bench_.state.actuators[1].fault_code, 0);
  EXPECT_EQ(recovery(0), "nothing to do");
  EXPECT_EQ(recovery(1), "fault 0x2310 over-current: fault reset");
  EXPECT_EQ(bench_.drives[1].resets, 1) << "no reset of the communication for a fault of the motor";
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(BridgeRecovery, FaultThatCannotBeResetFailsAndStaysLatched) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.drives[1].stuck_in_fault = true;
  bench_.run(900);
  const OperatorReply reply = bench_.ask_and_wait(OperatorKind::kClear);
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
  EXPECT_STREQ(reply.reason, "a drive's fault cannot be reset; see BUS_STATE");
  EXPECT_EQ(recovery(1), "fault 0x2310 over-current: cannot be reset");
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_TRUE(latched());
  EXPECT_EQ(bench_.drives[1].resets, 2) << "the communication reset was tried too, once";
  EXPECT_EQ(bench_.drives[0].resets, 1);
}

TEST_F(BridgeRecovery, DriveThatFallsSilentAfterItsResetFailsTheClear) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.run(900);
  bench_.ask(OperatorKind::kClear);
  for (int i = 0; i < 1000 && bench_.drives[1].power == PowerState::kFault; ++i) bench_.tick();
  bench_.tick();  // so that it is seen
  bench_.drives[1].mute_samples = true;
  OperatorReply reply;
  for (int i = 0; i < 600 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
  EXPECT_STREQ(reply.reason, "a drive is in fault again; see BUS_STATE");
  EXPECT_TRUE(latched());
}

TEST_F(BridgeRecovery, FaultThatOnlyACommunicationResetHealsGetsItInTheSameClear) {
  bench_.drives[1].pending_emergency = 0x3220;  // an 0x81xx before it was not heard
  bench_.drives[1].stuck_in_fault = bench_.drives[1].reset_heals_stuck_fault = true;
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  EXPECT_THAT(recovery(1), HasSubstr("fault 0x3220"));
  EXPECT_THAT(recovery(1), HasSubstr("reset communication, configured again ("));
  EXPECT_EQ(bench_.drives[0].resets, 1) << "the other one is left alone";
  EXPECT_EQ(recovery(0), "nothing to do");
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(BridgeRecovery, CommunicationFaultIsRememberedWhenAnotherFaultFollows) {
  bench_.bridge->receive(0, canopen::emergency_frame(2, {0x8130, 0x11}), bench_.time_us);
  bench_.drives[1].pending_emergency = 0x3220;
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  EXPECT_EQ(bench_.drives[1].resets, 2);
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench_.drives[1].resets, 2) << "forgotten with that reset";
}

/// 0x8130, 0x8120, 0x8210 and their like: reset communication, everything anew, then fault reset.
TEST_F(BridgeRecovery, CommunicationFaultsNeedTheCommunicationResetFirst) {
  for (const int code : {0x8110, 0x8120, 0x8130, 0x81FD, 0x8210}) {
    SCOPED_TRACE(code);
    bench_.drives[0].pending_emergency = static_cast<std::uint16_t>(code);
    bench_.drives[0].loses_settings_on_reset = true;
    bench_.run(900);
    ASSERT_EQ(cause(), SafetyCause::kDriveFault);
    const int resets = bench_.drives[0].resets;
    const int resets_of_other = bench_.drives[1].resets;
    bench_.drives[0].received.clear();
    ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
    EXPECT_EQ(bench_.drives[0].resets, resets + 1);
    EXPECT_EQ(bench_.drives[1].resets, resets_of_other);
    EXPECT_THAT(recovery(0), HasSubstr("reset communication, configured again ("));
    EXPECT_EQ(bench_.drives[0].received.front(),
              canopen::nmt_frame(canopen::NmtCommand::kResetCommunication, 1));
    EXPECT_EQ((bench_.drives[0].objects[{canopen::kMaxTorque, 0}]), 5571U);
    EXPECT_EQ(bench_.drives[0].power, PowerState::kSwitchOnDisabled);
    bench_.enable();
    ASSERT_EQ(enabled(), 2);
  }
}

TEST_F(BridgeRecovery, LongestTextIsToldToItsEnd) {
  bench_.drives[0].pending_emergency = 0x8130;
  bench_.run(900);
  ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  EXPECT_THAT(recovery(0),
              ::testing::StartsWith("fault 0x8130 life guard or heartbeat lost: reset communication"));
  EXPECT_THAT(recovery(0), ::testing::EndsWith(" objects), fault reset"));
}

TEST_F(BridgeRecovery, OtherDrivesKeepTheirSyncMeanwhile) {
  bench_.drives[0].pending_emergency = 0x8130;
  bench_.run(900);
  bench_.ask(OperatorKind::kClear);
  const std::int64_t missing = health(1).missing_samples;
  bench_.run(400);
  EXPECT_EQ(health(1).missing_samples, missing);
  EXPECT_EQ(bench_.state.actuators[1].age_cycles, 0);
  EXPECT_FALSE(latched());
}

TEST_F(BridgeRecovery, DriveThatLeftOperationalIsConfiguredAgain) {
  bench_.drives[0].nmt = canopen::NmtState::kPreOperational;
  bench_.drives[0].power = PowerState::kSwitchOnDisabled;
  bench_.run(900);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench_.drives[0].resets, 2);
  EXPECT_EQ(bench_.drives[0].nmt, canopen::NmtState::kOperational);
  EXPECT_THAT(recovery(0), HasSubstr("silent: reset communication, configured again"));
  expect_stays_off();
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(BridgeRecovery, DriveThatIsRefusedWhenConfiguredAgainIsNamedAndTriedAgainByEveryClear) {
  bench_.drives[0].nmt = canopen::NmtState::kPreOperational;
  bench_.drives[0].power = PowerState::kSwitchOnDisabled;
  bench_.drives[0].clamped[{canopen::kMaxTorque, 0}] = 5000;
  bench_.run(900);
  for (int resets = 2; resets < 4; ++resets) {
    const OperatorReply reply = bench_.ask_and_wait(OperatorKind::kClear);
    EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
    EXPECT_STREQ(reply.reason, "a node differs from robot.yaml; see SAFETY_STATE");
    bench_.tick();
    EXPECT_EQ(bench_.drives[0].resets, resets);
    EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
    EXPECT_EQ(bench_.detail(), "hip_motor: object 0x6072:00 max torque: expected 5571, found 5000");
    EXPECT_EQ(recovery(0), bench_.detail());
  }
  bench_.drives[0].clamped.clear();
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
}

TEST_F(BridgeRecovery, CutCableFailsInTimeAndNamesTheNodeUntilItIsPluggedIn) {
  bench_.drives[1].dead = true;
  bench_.run(900);
  const std::int64_t begun_us = bench_.time_us;
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kFailed);
  EXPECT_LE(bench_.time_us - begun_us, 5'100'000);
  EXPECT_EQ(recovery(0), "nothing to do");
  EXPECT_EQ(recovery(1), "no answer on node 2: power, cable?");
  EXPECT_TRUE(latched());
  bench_.drives[1].dead = false;
  bench_.drives[1].power = PowerState::kSwitchOnDisabled;
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

}  // namespace
}  // namespace sprung
