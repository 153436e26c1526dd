// Design section 8, done to the bridge with fake drives: every row that is the bridge's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

using BridgeSafety = test::PoweredBridge;

/// The leg controller lets the robot down: it has had no LEG_COMMAND for longer than command_stop.
class LoweringBridge : public test::PoweredBridge {
 protected:
  void SetUp() override {
    test::PoweredBridge::SetUp();
    bench_.command.used_leg_command_seq = 0;
    bench_.run(250);
    ASSERT_EQ(level(), SafetyLevel::kLowering) << bench_.detail();
    ASSERT_EQ(enabled(), 2);
  }
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

TEST_F(BridgeSafety, DampingThatIsOverIsToldUntilTheOperatorClears) {
  const auto detail = [this] { return std::string(bench_.bridge->safety().detail.data()); };
  bench_.mute_commands = true;
  bench_.run(50);
  bench_.mute_commands = false;
  bench_.run(500);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  EXPECT_EQ(cause(), SafetyCause::kNone);
  EXPECT_EQ(detail().find("was damping in cycle "), 0U) << detail();
  EXPECT_NE(detail().find("command stale: no good DRIVE_COMMAND for "), std::string::npos) << detail();
  EXPECT_STREQ(bench_.ask_and_wait(OperatorKind::kClear).reason, "nothing was latched");
  bench_.tick();
  EXPECT_EQ(detail(), "");
  EXPECT_EQ(enabled(), 2) << "to forget takes no torque";
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
  bench_.run(305);
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  bench_.run(600);
  EXPECT_EQ(powered(), 0);
}

TEST_F(BridgeSafety, LegCommandThatStaysAwayIsAPlannerThatIsLost) {
  for (int i = 0; i < 195; ++i) {
    bench_.command.used_leg_command_seq = bench_.bridge->safety().stamp.seq - i;  // none since
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kOperational) << "a stall: " << bench_.detail();
  for (int i = 195; i < 210; ++i) {
    bench_.command.used_leg_command_seq = bench_.bridge->safety().stamp.seq - i;
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kLowering);
  EXPECT_EQ(cause(), SafetyCause::kPlannerLost);
  EXPECT_TRUE(latched());
  EXPECT_THAT(bench_.detail(), HasSubstr("ms old: is sprung-motion-planner dead?"));
  bench_.command.used_leg_command_seq = bench_.bridge->safety().stamp.seq;
  bench_.run(1480);
  EXPECT_EQ(level(), SafetyLevel::kLowering) << "one that comes back changes nothing";
  bench_.run(40);
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  bench_.run(320);
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  expect_stays_off();
}

TEST_F(LoweringBridge, ObeysCommands) {
  bench_.command_all(DriveMode::kTorque, 30.8);
  bench_.run(30);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 1000);
}

TEST_F(LoweringBridge, WithoutCommandsItDamps) {
  bench_.mute_commands = true;
  bench_.run(25);
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kPlannerLost);
}

TEST_F(LoweringBridge, EndsWithAnyFault) {
  bench_.drives[1].pending_emergency = 0x2310;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kDriveFault) << "a worse level brings its cause";
}

TEST_F(LoweringBridge, IsNotCutShortByAClear) {
  EXPECT_STREQ(bench_.ask(OperatorKind::kClear).reason, "the robot is being let down: wait until it is off");
  bench_.run(10);
  EXPECT_EQ(level(), SafetyLevel::kLowering);
}

TEST_F(LoweringBridge, EndsAtOnceInAnEmergencyStop) {
  bench_.ask(OperatorKind::kEstop);
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kDisabled);
  EXPECT_EQ(powered(), 0);
}

TEST_F(LoweringBridge, EnablesNothing) {
  bench_.command_all(DriveMode::kDisabled);
  bench_.run(50);
  EXPECT_EQ(powered(), 0);
  bench_.command_all(DriveMode::kPosition);
  bench_.run(50);
  EXPECT_EQ(powered(), 0);
}

TEST_F(BridgeSafety, PlannerOfARobotWithoutPowerIsNotMissed) {
  bench_.command_all(DriveMode::kDisabled);
  bench_.run(50);
  ASSERT_EQ(powered(), 0);
  bench_.command.used_leg_command_seq = 0;
  bench_.run(500);
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
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
    bench_.run(305);
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
    bench_.run(600);
    EXPECT_EQ(powered(), 0);
    EXPECT_EQ(bench_.drives[1].enabled_count, enabled_before) << "it was enabled again";
    EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
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
}

TEST_F(BridgeSafety, MissingHeartbeatStopsTheRobot) {
  bench_.drives[0].mute_heartbeat = true;
  bench_.run(90);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.run(20);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor: no heartbeat"));
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
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0) << "nor by what it said before or will say";
  bench_.run(20);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
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
  // The bridge is replaced while the drives stand enabled; a controller that kept commanding torque must not
  // move them.
  bench_.command_all(DriveMode::kTorque, 5.0);
  bench_.bridge = std::make_unique<BridgeCore>(bench_.robot, BridgeOptions{bench_.robot.watchdogs});
  ASSERT_TRUE(bench_.boot());
  EXPECT_EQ(powered(), 0);
  expect_stays_off();
}

}  // namespace
}  // namespace sprung
