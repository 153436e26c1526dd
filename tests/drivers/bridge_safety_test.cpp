// Design section 8, done to the bridge with fake drives: every row that is the bridge's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using testing::BridgeBench;
using ::testing::HasSubstr;

class BridgeSafety : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(bench_.boot());
    bench_.enable();
    ASSERT_EQ(enabled(), 2);
    for (auto& drive : bench_.drives) enabled_before_.push_back(drive.enabled_count);
  }

  int enabled() const {
    int count = 0;
    for (const auto& drive : bench_.drives) count += drive.power == PowerState::kOperationEnabled ? 1 : 0;
    return count;
  }
  int powered() const {
    int count = 0;
    for (const auto& drive : bench_.drives) {
      count +=
          drive.power == PowerState::kOperationEnabled || drive.power == PowerState::kQuickStopActive ? 1 : 0;
    }
    return count;
  }
  SafetyLevel level() const { return bench_.bridge->safety().level; }
  SafetyCause cause() const { return bench_.bridge->safety().cause; }
  bool latched() const { return bench_.bridge->safety().latched; }
  /// Commands torque for a while: nothing may come on again.
  void expect_stays_off() {
    bench_.command_all(DriveMode::kTorque, 5.0);
    bench_.run(300);
    EXPECT_EQ(enabled(), 0);
    for (std::size_t i = 0; i < bench_.drives.size(); ++i) {
      EXPECT_EQ(bench_.drives[i].enabled_count, enabled_before_[i]) << "drive " << i << " was enabled again";
    }
  }

  BridgeBench bench_;
  std::vector<int> enabled_before_;
};

TEST_F(BridgeSafety, StaleCommandIsHeldThenDampedThenStoppedForGood) {
  bench_.command_all(DriveMode::kTorque, 30.8);
  bench_.run(10);
  bench_.mute_commands = true;
  bench_.run(20);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 1000) << "the last command is held";
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kCommandStale);
  EXPECT_FALSE(latched());
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
  EXPECT_EQ(enabled(), 2);
  bench_.run(180);
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  EXPECT_TRUE(latched());
  EXPECT_EQ(bench_.drives[0].power, PowerState::kQuickStopActive);
  bench_.run(550);
  EXPECT_EQ(powered(), 0);
  EXPECT_EQ(cause(), SafetyCause::kCommandStale);
  bench_.mute_commands = false;
  expect_stays_off();
}

TEST_F(BridgeSafety, GoodCommandEndsTheDampingOfAStaleOne) {
  bench_.mute_commands = true;
  bench_.run(50);
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  bench_.mute_commands = false;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeSafety, DampingOpposesMotionWhileNobodyCommands) {
  bench_.mute_commands = true;
  for (int i = 0; i < 60; ++i) {
    bench_.drives[1].position_counts += 2086;  // -1 rad/s in actuator space: this drive's direction is -1
    bench_.tick();
  }
  EXPECT_NEAR(bench_.drives[1].target_torque_permille, -1000.0 * 12.0 / 30.8, 3.0);
  EXPECT_EQ(bench_.drives[1].mode, 10);
}

TEST_F(BridgeSafety, DriveThatNeverEndsItsQuickStopLosesVoltageAfterHalfASecond) {
  bench_.drives[0].stuck_in_quick_stop = true;
  bench_.mute_commands = true;
  bench_.run(220);
  EXPECT_EQ(bench_.drives[0].power, PowerState::kQuickStopActive);
  bench_.run(470);
  EXPECT_EQ(powered(), 1);
  bench_.run(40);
  EXPECT_EQ(powered(), 0);
}

TEST_F(BridgeSafety, RefusedCommandsDampWhenNoGoodOneIsLeft) {
  bench_.command.actuators[1].commanded_torque_Nm = std::numeric_limits<double>::quiet_NaN();
  bench_.run(25);
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kCommandRefused);
  EXPECT_THAT(bench_.detail(), HasSubstr("knee_motor: commanded torque"));
  EXPECT_EQ(bench_.bridge->safety().commands_refused, 25);
}

TEST_F(BridgeSafety, EmergencyStopTakesThePowerAtOnceAndStays) {
  bench_.ask(OperatorKind::kEstop);
  EXPECT_EQ(level(), SafetyLevel::kDisabled);
  bench_.tick();
  EXPECT_EQ(powered(), 0);
  EXPECT_EQ(cause(), SafetyCause::kEmergencyStop);
  expect_stays_off();
}

TEST_F(BridgeSafety, ClearNeedsADisabledCommandBeforeTorqueComesBack) {
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  bench_.command_all(DriveMode::kTorque, 5.0);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  expect_stays_off();
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeSafety, ClearIsRefusedWhileDrivesStillStop) {
  bench_.mute_commands = true;
  bench_.run(230);
  const OperatorReply reply = bench_.ask(OperatorKind::kClear);
  EXPECT_EQ(reply.outcome, OperatorOutcome::kRefused);
  EXPECT_STREQ(reply.reason, "drives are still stopping");
}

TEST_F(BridgeSafety, ClearIsRefusedWhileNobodyCommands) {
  bench_.mute_commands = true;
  bench_.run(800);
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "no good DRIVE_COMMAND is coming in");
  bench_.mute_commands = false;
  bench_.run(2);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
}

TEST_F(BridgeSafety, DriveFaultDampsTheWholeRobotThenStopsIt) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_TRUE(latched());
  EXPECT_EQ(bench_.bridge->safety().actuator, 1);
  EXPECT_THAT(bench_.detail(), HasSubstr("knee_motor: drive fault 0x2310 (over-current)"));
  EXPECT_EQ(bench_.state.actuators[1].fault_code, 0x2310);
  EXPECT_EQ(bench_.drives[0].power, PowerState::kOperationEnabled) << "the healthy one damps";
  bench_.run(205);
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  bench_.run(600);
  EXPECT_EQ(powered(), 0);
}

TEST_F(BridgeSafety, ClearResetsTheFaultOfADrive) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.run(900);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kFault);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.run(100);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kSwitchOnDisabled);
  EXPECT_EQ(bench_.state.actuators[1].fault_code, 0);
  EXPECT_FALSE(latched());
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(BridgeSafety, FaultThatCannotBeResetLatchesAgain) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.run(900);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  for (int i = 0; i < 400; ++i) {
    bench_.drives[1].power = PowerState::kFault;
    bench_.tick();
  }
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_TRUE(latched());
}

TEST_F(BridgeSafety, DriveThatLosesItsPowerByItselfStopsTheRobotAndStaysOff) {
  for (const PowerState state :
       {PowerState::kSwitchOnDisabled, PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn}) {
    SCOPED_TRACE(name(state));
    const int enabled_before = bench_.drives[1].enabled_count;
    bench_.drives[1].lose_power(state);
    bench_.tick();
    EXPECT_EQ(level(), SafetyLevel::kDamping);
    EXPECT_EQ(cause(), SafetyCause::kDriveFault);
    EXPECT_TRUE(latched());
    EXPECT_EQ(bench_.detail(), "knee_motor: lost its power by itself");
    EXPECT_EQ(bench_.drives[0].power, PowerState::kOperationEnabled) << "the healthy one damps";
    bench_.run(205);
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
    bench_.run(600);
    EXPECT_EQ(powered(), 0);
    EXPECT_EQ(bench_.drives[1].enabled_count, enabled_before) << "it was enabled again";
    EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
    bench_.enable();
    EXPECT_EQ(enabled(), 2);
    EXPECT_FALSE(latched());
  }
}

TEST_F(BridgeSafety, PowerLostWhileACommandIsStaleIsLatchedToo) {
  bench_.mute_commands = true;
  bench_.run(50);
  EXPECT_EQ(cause(), SafetyCause::kCommandStale);
  bench_.drives[0].lose_power();
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_TRUE(latched());
}

TEST_F(BridgeSafety, PowerTakenAndGivenByCommandsIsNotLost) {
  for (int i = 0; i < 40; ++i) {
    bench_.command_all(i % 4 < 2 ? DriveMode::kDisabled : DriveMode::kTorque);
    bench_.run(i % 7 + 1);
    EXPECT_FALSE(latched()) << bench_.detail();
  }
}

TEST_F(BridgeSafety, EmergencyThatIsWithdrawnInTheSameCycleStillStopsTheRobot) {
  bench_.drives[1].passing_emergency = 0x8130;
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_TRUE(latched());
  EXPECT_THAT(bench_.detail(), HasSubstr("knee_motor: drive fault 0x8130"));
  EXPECT_EQ(bench_.state.actuators[1].fault_code, 0x8130);
  bench_.tick();
  EXPECT_EQ(bench_.state.actuators[1].fault_code, 0) << "it was withdrawn";
}

TEST_F(BridgeSafety, SilenceIsHeldForTwoCyclesThenStopsTheRobot) {
  bench_.drives[0].mute_samples = true;
  bench_.run(2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  EXPECT_EQ(bench_.state.actuators[0].age_cycles, 2);
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor: did not answer SYNC for 3 cycles"));
  bench_.run(900);
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "a drive does not answer");
}

TEST_F(BridgeSafety, MissingHeartbeatStopsTheRobot) {
  bench_.drives[0].mute_heartbeat = true;
  bench_.run(90);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.run(20);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor: no heartbeat"));
}

TEST_F(BridgeSafety, DriveThatLeavesOperationalIsConfiguredAgainByClear) {
  bench_.drives[0].nmt = canopen::NmtState::kPreOperational;
  bench_.drives[0].power = PowerState::kSwitchOnDisabled;
  bench_.run(900);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("configured again"));
  bench_.run(400);
  EXPECT_EQ(bench_.drives[0].resets, 2);
  EXPECT_EQ(bench_.drives[0].nmt, canopen::NmtState::kOperational);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  expect_stays_off();
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(BridgeSafety, DriveThatIsRefusedWhenConfiguredAgainIsNamedAndTriedAgainByEveryClear) {
  bench_.drives[0].nmt = canopen::NmtState::kPreOperational;
  bench_.drives[0].power = PowerState::kSwitchOnDisabled;
  bench_.drives[0].clamped[{canopen::kMaxTorque, 0}] = 5000;
  bench_.run(900);
  for (int resets = 2; resets < 4; ++resets) {
    EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("configured again"));
    bench_.run(400);
    EXPECT_EQ(bench_.drives[0].resets, resets);
    EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
    EXPECT_EQ(bench_.detail(), "hip_motor: object 0x6072:00 max torque: expected 5571, found 5000");
  }
  bench_.drives[0].clamped.clear();
  bench_.ask(OperatorKind::kClear);
  bench_.run(400);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
}

TEST_F(BridgeSafety, PositionThatJumpsIsImplausible) {
  bench_.drives[1].position_counts += 131072 * 20;
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kImplausible);
  EXPECT_THAT(bench_.detail(), HasSubstr("knee_motor: measured position jumped"));
}

TEST_F(BridgeSafety, DampingIsNotFedByAPositionThatJumps) {
  for (int i = 0; i < 50; ++i) {
    bench_.drives[0].position_counts += 2086;  // 1 rad/s
    bench_.tick();
  }
  bench_.drives[0].position_counts += 131072 * 20;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_NEAR(bench_.drives[0].target_torque_permille, -1000.0 * 12.0 / 30.8, 3.0);
}

TEST_F(BridgeSafety, DriveThatDidNotAnswerIsNotDampedByItsLastVelocity) {
  bench_.mute_commands = true;
  for (int i = 0; i < 50; ++i) {
    bench_.drives[0].position_counts += 2086;  // 1 rad/s
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_LT(bench_.drives[0].target_torque_permille, -300);
  bench_.drives[0].mute_samples = true;
  bench_.tick();
  EXPECT_EQ(bench_.drives[0].power, PowerState::kOperationEnabled);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
}

TEST_F(BridgeSafety, BusOffIsAQuickStopUntilFramesComeAgain) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  for (auto& drive : bench_.drives) drive.mute_samples = drive.mute_heartbeat = true;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  EXPECT_EQ(cause(), SafetyCause::kBusLost);
  EXPECT_THAT(bench_.detail(), HasSubstr("bus leg (memory:leg) is lost"));
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "a bus is lost; see SAFETY_STATE");
  for (auto& drive : bench_.drives) drive.mute_samples = drive.mute_heartbeat = false;
  bench_.run(900);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
}

TEST_F(BridgeSafety, OverrunsInARowDampUntilACycleIsInTime) {
  for (int i = 0; i < 10; ++i) {
    bench_.bridge->count_overrun(bench_.time_us);
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kOverruns);
  EXPECT_EQ(bench_.bridge->safety().overruns, 10);
  bench_.bridge->count_good_cycle();
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.bridge->count_missed_cycle();
  EXPECT_EQ(bench_.bridge->safety().missed_cycles, 1);
}

TEST_F(BridgeSafety, NewBridgeNeverTurnsTorqueBackOn) {
  // The bridge is replaced while the drives stand enabled; a controller that kept commanding torque must not move them.
  bench_.command_all(DriveMode::kTorque, 5.0);
  bench_.bridge = std::make_unique<BridgeCore>(bench_.robot, BridgeOptions{bench_.robot.watchdogs});
  ASSERT_TRUE(bench_.boot());
  EXPECT_EQ(powered(), 0);
  expect_stays_off();
}

}  // namespace
}  // namespace sprung
