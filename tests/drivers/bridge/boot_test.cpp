// Start-up of one drive, request by request (facts canopen 1.5 and 1.6).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/bridge/node_boot.h"
#include "drivers/can/can_errors.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;
using test::BridgeBench;
using test::FakeDrive;

std::vector<std::vector<int>> writes(const FakeDrive& drive) {
  std::vector<std::vector<int>> found;
  for (const CanFrame& frame : drive.received) {
    const bool write = frame.id != kNmtId && decode_sdo_request(frame).kind == SdoKind::kDownload;
    if (write) found.push_back({frame.data.begin(), frame.data.end()});
  }
  return found;
}

TEST(Boot, FirstResetsThenReadsTheIdentityThenTakesPowerAway) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  const std::vector<CanFrame>& received = bench.drives[0].received;
  EXPECT_EQ(received[0], nmt_frame(NmtCommand::kResetCommunication, 1));
  EXPECT_EQ(received[1], sdo_read_request(1, {kIdentity, 1}));
  EXPECT_EQ(received[2], sdo_read_request(1, {kIdentity, 2}));
  EXPECT_EQ(received[3], sdo_read_request(1, {kIdentity, 3}));
  EXPECT_EQ(received[4], sdo_write_request(1, {kControlWord, 0}, 0, 2));
  EXPECT_EQ(received[5], sdo_read_request(1, {kSupportedModes, 0}));
  EXPECT_EQ(received.back(), nmt_frame(NmtCommand::kStart, 1));
}

TEST(Boot, RemapsWithTheBytesAndOrderThatDrivesAccept) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  const std::vector<std::vector<int>> expected = {
      {0x23, 0x00, 0x18, 0x01, 0x81, 0x01, 0x00, 0xC0}, {0x2F, 0x00, 0x18, 0x02, 0x01, 0, 0, 0},
      {0x2F, 0x00, 0x1A, 0x00, 0x00, 0, 0, 0},          {0x23, 0x00, 0x1A, 0x01, 0x20, 0x00, 0x64, 0x60},
      {0x23, 0x00, 0x1A, 0x02, 0x10, 0x00, 0x77, 0x60}, {0x23, 0x00, 0x1A, 0x03, 0x10, 0x00, 0x41, 0x60},
      {0x2F, 0x00, 0x1A, 0x00, 0x03, 0, 0, 0},          {0x23, 0x00, 0x18, 0x01, 0x81, 0x01, 0x00, 0x40}};
  const auto found = writes(bench.drives[0]);
  const auto at = std::search(found.begin(), found.end(), expected.begin(), expected.end());
  EXPECT_NE(at, found.end());
}

TEST(Boot, EveryWriteButTheControlWordIsReadBack) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  const std::vector<CanFrame>& received = bench.drives[1].received;
  for (std::size_t i = 0; i + 1 < received.size(); ++i) {
    const SdoMessage request = decode_sdo_request(received[i]);
    if (received[i].id == kNmtId || request.kind != SdoKind::kDownload ||
        request.object.index == kControlWord)
      continue;
    EXPECT_EQ(received[i + 1], sdo_read_request(2, request.object)) << std::hex << request.object.index;
  }
}

TEST(Boot, LeavesTheSettingsOfTheRobotsFileInTheDrive) {
  BridgeBench bench;
  bench.drives[0].objects[{kTorqueOffset, 0}] = 300;  // left by somebody
  ASSERT_TRUE(bench.boot());
  auto& objects = bench.drives[0].objects;
  EXPECT_EQ((objects[{kTorqueOffset, 0}]), 0U);
  EXPECT_EQ((objects[{kMaxMotorSpeed, 0}]), 11459U);
  EXPECT_EQ((objects[{0x1801, 2}]), 7U) << "the mode display comes at every seventh SYNC, asked or not";
  EXPECT_EQ((objects[{0x2F75, 0}]), 5U);
  EXPECT_EQ((objects[{kHeartbeatConsumer, 1}]), 0x007F0014U);
  EXPECT_EQ((objects[{kHeartbeatProducer, 0}]), 5U);
  EXPECT_EQ((objects[{kAbortConnectionOption, 0}]), 2U);
  EXPECT_EQ((objects[{kMaxTorque, 0}]), 5571U);
  EXPECT_EQ((objects[{0x1402, 1}]), 0x80000401U) << "RPDO3 is disabled";
  EXPECT_EQ((objects[{0x1803, 1}]), 0xC0000481U) << "TPDO4 is disabled";
}

TEST(Boot, WrongIdentityIsRefusedAndNamed) {
  BridgeBench bench;
  bench.drives[1].objects[{kIdentity, 1}] = 0xFB;
  EXPECT_FALSE(bench.boot(500));
  EXPECT_EQ(bench.bridge->safety().cause, SafetyCause::kDriveRefused);
  EXPECT_TRUE(bench.bridge->safety().latched);
  EXPECT_EQ(bench.bridge->safety().actuator, 1);
  EXPECT_EQ(bench.detail(), "knee_motor: object 0x1018:01 identity: expected 0x9A, found 0xFB");
  EXPECT_TRUE(writes(bench.drives[1]).empty())
      << "nothing is written to a device that is not the one expected";
  EXPECT_EQ(bench.drives[0].nmt, NmtState::kPreOperational);
}

TEST(Boot, SettingThatTheDriveClampsIsRefusedAndNamed) {
  BridgeBench bench;
  bench.drives[1].clamped[{kMaxTorque, 0}] = 5000;
  EXPECT_FALSE(bench.boot(500));
  EXPECT_EQ(bench.detail(), "knee_motor: object 0x6072:00 max torque: expected 5571, found 5000");
}

TEST(Boot, SettingThatTheDriveAbortsIsRefusedWithItsReason) {
  BridgeBench bench;
  bench.drives[0].aborts[{kMaxMotorSpeed, 0}] = kAbortNoObject;
  EXPECT_FALSE(bench.boot(500));
  EXPECT_EQ(bench.detail(),
            "hip_motor: object 0x6080:00 max motor speed: refused by the drive (no such object)");
}

bool touched(const FakeDrive& drive, std::uint16_t index) {
  return std::any_of(drive.received.begin(), drive.received.end(), [index](const CanFrame& frame) {
    return frame.id != kNmtId && decode_sdo_request(frame).object.index == index;
  });
}

// A Gold runs by CiA 402 alone: what 0x2F75 means on another firmware nobody here knows.
TEST(Boot, GoldOfUnknownFirmwareRunsWithoutItsMakersObjectsAndIsReported) {
  BridgeBench bench;
  bench.drives[1].objects[{kIdentity, 3}] = 0x00010400;
  ASSERT_TRUE(bench.boot()) << bench.detail();
  EXPECT_FALSE(touched(bench.drives[1], 0x2F75));
  EXPECT_TRUE(touched(bench.drives[0], 0x2F75));
  const std::vector<std::string> report = bench.bridge->boot_report();
  EXPECT_THAT(report, ::testing::Contains(HasSubstr("knee_motor: firmware 0x00010400 is none that")));
  EXPECT_THAT(report, ::testing::Not(::testing::Contains(HasSubstr("hip_motor: firmware"))));
}

TEST(Boot, RevisionThatIsTypedIsTheOneThatRuns) {
  RobotConfig robot = test::two_drive_robot();
  robot.actuators[1].identity.revision = 0x00010400;
  BridgeBench bench(robot);
  bench.drives[1].objects[{kIdentity, 3}] = 0x00010400;
  ASSERT_TRUE(bench.boot());
  EXPECT_TRUE(touched(bench.drives[1], 0x2F75)) << "who types it has checked its objects";
}

TEST(Boot, DriveWithoutAModeThatIsNeededIsRefusedBeforeAnySetting) {
  BridgeBench bench;
  bench.drives[0].objects[{kSupportedModes, 0}] = 0x80;  // cyclic position alone
  EXPECT_FALSE(bench.boot(500));
  EXPECT_EQ(bench.detail(), "hip_motor: object 0x6502:00 supported modes: expected 640, found 128");
  EXPECT_FALSE(touched(bench.drives[0], kRatedCurrent));
}

TEST(Boot, PositionLoopOnTheHostNeedsTheTorqueModeAlone) {
  RobotConfig robot = test::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) actuator.position_loop = PositionLoopSide::kHost;
  BridgeBench bench(robot);
  for (FakeDrive& drive : bench.drives) drive.objects[{kSupportedModes, 0}] = 0x200;
  EXPECT_TRUE(bench.boot()) << bench.detail();
}

// A Gold's file limits 0x1016 to 65535, where no node id has room.
TEST(Boot, DriveThatRefusesTheHeartbeatConsumerIsGuardedAndReported) {
  BridgeBench bench;
  bench.drives[1].aborts[{kHeartbeatConsumer, 1}] = kAbortTooHigh;
  ASSERT_TRUE(bench.boot()) << bench.detail();
  auto& objects = bench.drives[1].objects;
  EXPECT_EQ((objects[{kHeartbeatProducer, 0}]), 0U) << "a node that sends heartbeats is not guarded";
  EXPECT_EQ((objects[{kGuardTime, 0}]), 5U);
  EXPECT_EQ((objects[{kLifeTimeFactor, 0}]), 4U);
  EXPECT_EQ((bench.drives[0].objects.count({kGuardTime, 0})), 0U) << "the other takes the heartbeat";
  EXPECT_THAT(bench.bridge->boot_report(),
              ::testing::Contains(HasSubstr("knee_motor: refuses to watch the bridge's heartbeat")));
  bench.enable();
  bench.run(500);
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational) << bench.detail();
  bool asked = false;
  for (int i = 0; i < 6; ++i, bench.tick()) asked = asked || !bench.sent(heartbeat_id(2)).empty();
  EXPECT_TRUE(asked) << "node guarding's question";
}

TEST(Boot, DriveThatCannotWatchTheBridgeAtAllIsRefused) {
  BridgeBench bench;
  bench.drives[1].aborts[{kHeartbeatConsumer, 1}] = kAbortTooHigh;
  bench.drives[1].aborts[{kGuardTime, 0}] = kAbortNoObject;
  EXPECT_FALSE(bench.boot(500));
  EXPECT_EQ(
      bench.detail(),
      "knee_motor: cannot watch the bridge: 0x1016 refused (value too high), guarding 0x100C refused (no "
      "such object)");
}

TEST(Boot, WhatItOverwritesIsListedWithBothValues) {
  BridgeBench bench;
  bench.drives[0].objects[{kRatedCurrent, 0}] = 2500;
  bench.drives[0].objects[{kMaxTorque, 0}] = 5571;  // as wanted
  ASSERT_TRUE(bench.boot());
  const std::vector<std::string> report = bench.bridge->boot_report();
  ASSERT_EQ(report.size(), 1U) << "what cannot be read has nothing to be listed";
  EXPECT_EQ(report[0], "hip_motor: boot has overwritten 0x6075:00 rated current (2500, now 7000)");
}

/// Nothing is half written and not said.
TEST(Boot, WhatItHasOverwrittenOfARefusedDriveIsListedToo) {
  BridgeBench bench;
  test::FakeDrive& drive = bench.drives[0];
  drive.objects[{kRatedCurrent, 0}] = 2500;
  drive.objects[{kMaxTorque, 0}] = 100;
  drive.write_aborts[{kMaxTorque, 0}] = kAbortDeviceState;
  ASSERT_FALSE(bench.boot(500));
  ASSERT_EQ((drive.objects[{kRatedCurrent, 0}]), 7000U);
  EXPECT_THAT(bench.bridge->boot_report(),
              ::testing::ElementsAre("hip_motor: boot has overwritten 0x6075:00 rated current (2500, now "
                                     "7000)"))
      << "and not what it refused";
}

TEST(Boot, RefusedDriveIsTriedAgainAfterClear) {
  BridgeBench bench;
  bench.drives[1].clamped[{kMaxTorque, 0}] = 5000;
  EXPECT_FALSE(bench.boot(500));
  bench.drives[1].clamped.clear();
  EXPECT_EQ(bench.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  EXPECT_TRUE(bench.boot(500));
}

TEST(Boot, ClearOfARefusedDriveIsDoneWhenTheRobotIsFree) {
  BridgeBench bench;
  bench.drives[1].clamped[{kMaxTorque, 0}] = 5000;
  ASSERT_FALSE(bench.boot(500));
  bench.drives[1].clamped.clear();
  const OperatorReply reply = bench.ask_and_wait(OperatorKind::kClear);
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_FALSE(bench.bridge->safety().latched) << bench.detail();
  ASSERT_TRUE(bench.boot(500));
  bench.enable();
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational) << bench.detail();
}

TEST(Boot, ClearOfADriveThatIsRefusedAgainFailsAndTellsTheNewReason) {
  BridgeBench bench;
  bench.drives[1].clamped[{kMaxTorque, 0}] = 5000;
  ASSERT_FALSE(bench.boot(500));
  bench.drives[1].clamped[{kMaxTorque, 0}] = 5500;
  EXPECT_EQ(bench.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kFailed);
  bench.tick();
  EXPECT_TRUE(bench.bridge->safety().latched);
  EXPECT_EQ(bench.detail(), "knee_motor: object 0x6072:00 max torque: expected 5571, found 5500");
}

/// Whenever it is asked: also in the cycle before the first one.
TEST(Boot, ClearIsAnsweredAlsoWhenTheFirstCycleComesMeanwhile) {
  BridgeBench measure;
  ASSERT_TRUE(measure.boot());
  const auto ticks = static_cast<int>(measure.time_us / 1000);
  for (int before = 1; before < 6; ++before) {
    SCOPED_TRACE(before);
    BridgeBench bench;
    bench.run(ticks - before);
    ASSERT_FALSE(bench.bridge->operational());
    bench.ask(OperatorKind::kEstop);
    EXPECT_EQ(bench.ask_and_wait(OperatorKind::kClear, 100).outcome, OperatorOutcome::kDone);
    ASSERT_TRUE(bench.boot());
    bench.run(20);
    EXPECT_FALSE(bench.bridge->safety().latched) << bench.detail();
  }
}

TEST(Boot, DriveThatLeavesOperationalBeforeTheFirstCycleIsConfiguredAgain) {
  BridgeBench bench;
  bench.drives[1].mute_samples = true;
  bench.run(500);
  ASSERT_EQ(bench.drives[0].nmt, NmtState::kOperational);
  EXPECT_THAT(bench.bridge->boot_detail(), HasSubstr("knee_motor: waiting for its first sample"));
  for (const bool restarts : {false, true}) {
    const int resets = bench.drives[0].resets;
    bench.drives[0].nmt = NmtState::kPreOperational;
    bench.drives[0].restart_now = restarts;
    bench.run(10);
    EXPECT_THAT(bench.bridge->boot_detail(), HasSubstr("hip_motor: "));
    EXPECT_EQ(bench.drives[0].resets, resets + 1);
    bench.run(500);
  }
  EXPECT_FALSE(bench.bridge->operational());
  bench.drives[1].mute_samples = false;
  ASSERT_TRUE(bench.boot(1000)) << bench.bridge->boot_detail();
  bench.enable();
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational) << bench.detail();
}

TEST(Boot, NodeThatMissesTheCycleThatAllShouldAnswerIsNamed) {
  BridgeBench bench;
  int cycle = 0;  // they answer in turn, so that neither is silent for long
  bench.on_answers = [&cycle](std::vector<CanFrame>& answers) {
    for (CanFrame& frame : answers) {
      if (frame.id == tpdo_id(0, 1 + cycle % 2)) frame.id = 0x7F0;
    }
  };
  for (int i = 0; i < 500; ++i, ++cycle) bench.tick();
  EXPECT_FALSE(bench.bridge->operational());
  EXPECT_STREQ(bench.bridge->boot_detail(), "knee_motor: did not answer SYNC");
}

TEST(Boot, DriveWithoutBootUpFrameIsProbed) {
  BridgeBench bench;
  bench.drives[0].boots_silently = true;
  ASSERT_TRUE(bench.boot(1500));
  EXPECT_EQ(bench.drives[0].received[1], sdo_read_request(1, {kDeviceType, 0}));
  EXPECT_EQ(bench.drives[0].received[2], nmt_frame(NmtCommand::kEnterPreOperational, 1));
}

// Its power came while it was asked: the answer to the probe is none to the script.
TEST(Boot, BootUpFrameDuringTheProbeBeginsTheScriptAtItsFirstStep) {
  SdoClient sdo(1, 100'000);
  NodeBoot boot("hip", 1, {{BootStep::Kind::kVerify, {{kIdentity, 1}, 4, 0x9A, false}}});
  CanFrame out;
  ASSERT_TRUE(boot.step(0, sdo, out));
  ASSERT_TRUE(boot.step(600'000, sdo, out));
  ASSERT_EQ(out, sdo_read_request(1, {kDeviceType, 0}));
  boot.on_heartbeat(NmtState::kBootUp, 600'500);
  sdo.receive(sdo_read_reply(1, {kDeviceType, 0}, 0x20192, 4));
  ASSERT_TRUE(boot.step(602'000, sdo, out));
  EXPECT_EQ(out, sdo_read_request(1, {kIdentity, 1})) << boot.detail().data();
  sdo.receive(sdo_read_reply(1, {kIdentity, 1}, 0x9A, 4));
  boot.step(604'000, sdo, out);
  EXPECT_TRUE(boot.configured()) << boot.detail().data();
}

TEST(Boot, ProbeThatABootUpFrameOvertookDoesNotDelayPowerOff) {
  SdoClient sdo(1, 100'000);
  NodeBoot boot("hip", 1, {{BootStep::Kind::kWrite, {{kControlWord, 0}, 2, 0, false}}});
  CanFrame out;
  boot.step(0, sdo, out);
  boot.step(600'000, sdo, out);
  boot.on_heartbeat(NmtState::kBootUp, 600'500);
  ASSERT_TRUE(boot.step(602'000, sdo, out)) << "the probe is never answered";
  EXPECT_EQ(out, sdo_write_request(1, {kControlWord, 0}, 0, 2));
}

TEST(Boot, DriveThatRestartsHalfWayIsConfiguredFromTheBeginning) {
  BridgeBench bench;
  bench.run(40);
  const std::size_t half_way = writes(bench.drives[0]).size();
  ASSERT_GT(half_way, 3U);
  bench.bridge->receive(0, heartbeat_frame(1, NmtState::kBootUp), bench.time_us);
  ASSERT_TRUE(bench.boot());
  EXPECT_EQ(bench.drives[0].resets, 2);
}

TEST(Boot, SilenceInTheMiddleBeginsAgain) {
  BridgeBench bench;
  bench.run(40);
  bench.drives[1].dead = true;
  bench.run(300);
  bench.drives[1].dead = false;
  EXPECT_TRUE(bench.boot(3000));
}

TEST(Boot, BusErrorThatIsGoneByTheFirstCycleIsForgotten) {
  BridgeBench bench;
  bench.run(10);
  bench.bridge->receive(0, bus_lost_frame(), bench.time_us);
  ASSERT_TRUE(bench.boot());
  EXPECT_FALSE(bench.bridge->safety().latched) << bench.detail();
  bench.enable();
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational);
}

TEST(Boot, BusThatIsLostInTheFirstCycleIsNotForgotten) {
  RobotConfig robot = test::two_drive_robot();
  robot.buses.push_back({"other", "memory:other"});
  BridgeBench bench(robot);
  bench.run(10);
  bench.bridge->receive(1, bus_lost_frame(), bench.time_us);
  ASSERT_TRUE(bench.boot());
  EXPECT_EQ(bench.bridge->safety().cause, SafetyCause::kBusLost);
}

TEST(Boot, EmergencyStopWhileBootingIsKept) {
  BridgeBench bench;
  bench.run(10);
  bench.ask(OperatorKind::kEstop);
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  EXPECT_EQ(bench.bridge->safety().cause, SafetyCause::kEmergencyStop);
  EXPECT_TRUE(bench.bridge->safety().latched);
}

}  // namespace
}  // namespace sprung
