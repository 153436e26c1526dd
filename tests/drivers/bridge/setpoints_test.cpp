// What the bridge sends to drives, and how it brings them to rest at its end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/cia402/words.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using test::BridgeBench;
using test::FakeDrive;
using test::two_drive_robot;
using ::testing::HasSubstr;

class StallBeforeEmit : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(bench_.boot());
    bench_.enable();
    bench_.command_all(DriveMode::kTorque, 30.8);
    bench_.run(5);
    ASSERT_EQ(bench_.drives[0].target_torque_permille, 1000);
  }
  /// Torque set-point of drive 1 when the shell stands still between command() and emit_setpoints().
  int torque_after(std::int64_t stall_us, std::int64_t valid_us) {
    bench_.time_us += 1000;
    FrameBatch out;
    bench_.bridge->begin_tick(bench_.time_us, out);
    for (const BusFrame& item : out) {
      std::vector<CanFrame> answers;
      for (FakeDrive& drive : bench_.drives) drive.receive(item.frame, answers);
      for (const CanFrame& answer : answers) bench_.bridge->receive(0, answer, bench_.time_us);
    }
    EXPECT_TRUE(bench_.bridge->end_sampling(bench_.time_us, bench_.state));
    bench_.command.stamp = bench_.state.stamp;
    bench_.command.valid_until_utime_us = bench_.time_us + valid_us;
    EXPECT_TRUE(bench_.bridge->command(bench_.command, bench_.time_us));
    out.clear();
    bench_.bridge->emit_setpoints(bench_.time_us + stall_us, out);
    for (const BusFrame& item : out) {
      if (item.frame.id == 0x201) return static_cast<std::int16_t>(canopen::get_le(&item.frame.data[0], 2));
    }
    return -1;
  }
  BridgeBench bench_;
};

TEST_F(StallBeforeEmit, ShortOneStillSendsTheCommand) { EXPECT_EQ(torque_after(19'000, 21'000), 1000); }

TEST_F(StallBeforeEmit, LongerThanTheHoldSendsNoOldTorque) {
  EXPECT_EQ(torque_after(20'001, 900'000), 0);
  EXPECT_EQ(bench_.bridge->safety().cause, SafetyCause::kCommandStale);
  EXPECT_FALSE(bench_.bridge->safety().latched);
}

TEST_F(StallBeforeEmit, PastItsOwnTimeSendsNoOldTorque) {
  EXPECT_EQ(torque_after(4'001, 4'000), 0);
  EXPECT_EQ(bench_.bridge->safety().cause, SafetyCause::kCommandStale);
  EXPECT_FALSE(bench_.bridge->safety().latched);
}

TEST(BridgeSetpoints, NothingIsEnabledBeforeACommandWithEveryModeDisabled) {
  BridgeBench bench;
  bench.command_all(DriveMode::kTorque, 5.0);
  ASSERT_TRUE(bench.boot());
  bench.run(200);
  EXPECT_EQ(bench.enabled(), 0);
  EXPECT_EQ(bench.state.safety, SafetyLevel::kDisabled);
  EXPECT_THAT(bench.detail(), HasSubstr("every mode disabled"));
}

/// Both drives' position loops are closed by the bridge.
RobotConfig host_loop_robot() {
  RobotConfig robot = two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) actuator.position_loop = PositionLoopSide::kHost;
  return robot;
}

TEST(BridgeSetpoints, PositionLoopOnTheHostSendsTorqueAndShowsPosition) {
  BridgeBench bench(host_loop_robot());
  ASSERT_TRUE(bench.boot());
  bench.enable(DriveMode::kPosition);
  EXPECT_EQ(bench.drives[0].mode, cia402::kModeCyclicTorque);
  EXPECT_EQ(bench.state.actuators[0].shown_mode, DriveMode::kPosition);
  const double here_rad = bench.state.actuators[0].measured_position_rad;
  bench.command_all(DriveMode::kPosition, 0.0, here_rad + 0.01);
  bench.run(5);
  // 503 Nm/rad over 0.01 rad, by 30.8 Nm of rated torque at the output
  EXPECT_EQ(bench.drives[0].target_torque_permille, std::lround(1000 * 5.03 / 30.8));
  EXPECT_EQ(bench.drives[0].mode, cia402::kModeCyclicTorque);
}

TEST(BridgeSetpoints, PositionLoopOnTheHostEndsWithTheMode) {
  BridgeBench bench(host_loop_robot());
  ASSERT_TRUE(bench.boot());
  bench.enable(DriveMode::kPosition);
  bench.command_all(DriveMode::kTorque, 3.08);
  bench.run(3);
  EXPECT_EQ(bench.state.actuators[0].shown_mode, DriveMode::kTorque);
  EXPECT_EQ(bench.drives[0].target_torque_permille, 100);
}

TEST(BridgeSetpoints, NothingIsEnabledBeforeTheFaultsOfTheStartAreReset) {
  BridgeBench bench;
  bench.drives[1].power = PowerState::kFault;
  bench.drives[1].stuck_in_fault = true;
  ASSERT_TRUE(bench.boot());
  bench.run(20);
  bench.command_all(DriveMode::kTorque, 5.0);
  for (int i = 0; i < 400; ++i) {
    bench.tick();
    ASSERT_EQ(bench.enabled(), 0) << i;
  }
  EXPECT_EQ(bench.bridge->safety().cause, SafetyCause::kDriveFault);
}

TEST(BridgeSetpoints, DriveThatHasNotConfirmedItsPositionLimitsGetsNoPower) {
  RobotConfig robot = test::with_leg(two_drive_robot(), 1.0);
  robot.actuators[0].position_limits_object = 0x607D;
  BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.on_answers = [](std::vector<CanFrame>& frames) {
    const auto of_hip = [](const CanFrame& frame) { return frame.id == canopen::sdo_server_id(1); };
    frames.erase(std::remove_if(frames.begin(), frames.end(), of_hip), frames.end());
  };
  bench.enable();
  bench.run(50);
  EXPECT_EQ(bench.drives[0].enabled_count, 0);
  EXPECT_EQ(bench.drives[1].enabled_count, 1);
  bench.on_answers = nullptr;
  bench.run(200);  // an answer is missed for 100 ms
  EXPECT_EQ(bench.drives[0].enabled_count, 1);
}

TEST(BridgeSetpoints, DriveThatIsNotEnabledYetIsToldNoTorqueAndThePositionWhereItIs) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.run(400);
  ASSERT_EQ(bench.state.safety, SafetyLevel::kOperational);
  for (const DriveMode mode : {DriveMode::kTorque, DriveMode::kPosition}) {
    bench.command_all(DriveMode::kDisabled);
    bench.run(5);
    bench.command_all(mode, mode == DriveMode::kTorque ? 5.0 : kNaN, 0.2);
    for (int i = 0; i < 20 && bench.drives[0].power != PowerState::kOperationEnabled; ++i) {
      bench.tick();
      EXPECT_EQ(bench.drives[0].target_torque_permille, 0) << i;
      EXPECT_EQ(bench.drives[0].target_position_counts, 0) << i;
    }
    EXPECT_EQ(bench.drives[0].power, PowerState::kOperationEnabled);
  }
}

TEST(BridgeSetpoints, EnabledDriveGetsItsTorqueAndShowsItsModeOnlyWhenConfirmed) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  ASSERT_GT(bench.enabled(), 0);
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational);
  EXPECT_EQ(bench.state.actuators[0].shown_mode, DriveMode::kTorque);
  bench.command_all(DriveMode::kTorque, 30.8);
  bench.tick();
  EXPECT_EQ(bench.drives[0].target_torque_permille, 1000);
  EXPECT_EQ(bench.drives[1].target_torque_permille, -1000);
}

TEST(BridgeSetpoints, TorqueModeCarriesTheMeasuredPositionForTheHandOver) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.drives[0].position_counts = 4321;
  bench.tick();
  EXPECT_EQ(bench.drives[0].target_position_counts, 4321);
  bench.command_all(DriveMode::kPosition, 0.0, 0.2);
  bench.tick();
  EXPECT_EQ(bench.drives[0].mode, 8);
  EXPECT_NEAR(bench.drives[0].target_position_counts, 0.1 * 131072 * 100 / (4 * std::acos(0.0)), 1.0);
  bench.tick();
  EXPECT_EQ(bench.state.actuators[0].shown_mode, DriveMode::kPosition);
}

TEST(BridgeSetpoints, DriveThatIsNotReferencedStaysWithoutTorque) {
  RobotConfig robot = two_drive_robot();
  robot.actuators[1].referenced = false;
  BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  EXPECT_EQ(bench.drives[0].power, PowerState::kOperationEnabled);
  EXPECT_NE(bench.drives[1].power, PowerState::kOperationEnabled);
  EXPECT_FALSE(bench.state.actuators[1].referenced);
}

TEST(BridgeSetpoints, DisabledCommandTakesTheTorqueAwayInOneCycle) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.command_all(DriveMode::kDisabled);
  bench.tick();
  EXPECT_EQ(bench.enabled(), 0);
}

TEST(BridgeSetpoints, DampingModeOpposesTheMeasuredMotion) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.command_all(DriveMode::kDamping);
  for (ActuatorCommand& actuator : bench.command.actuators) actuator.commanded_damping_Nm_s_rad = 10.0;
  for (int i = 0; i < 50; ++i) {
    bench.drives[0].position_counts += 2086;  // 1 rad/s
    bench.tick();
  }
  EXPECT_NEAR(bench.drives[0].target_torque_permille, -1000.0 * 10.0 / 30.8, 2.0);
  EXPECT_EQ(bench.drives[1].target_torque_permille, 0);
  bench.drives[0].mute_samples = true;
  bench.tick();
  EXPECT_EQ(bench.drives[0].target_torque_permille, 0) << "nothing is known of its motion in this cycle";
}

TEST(BridgeSetpoints, DampingModeEnablesNothing) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable(DriveMode::kDamping);
  EXPECT_EQ(bench.enabled(), 0);
  bench.enable();
  ASSERT_GT(bench.enabled(), 0);
  bench.command_all(DriveMode::kDamping);
  bench.run(50);
  EXPECT_GT(bench.enabled(), 0) << "what has torque keeps it";
}

TEST(BridgeSetpoints, ControlWordIsRepeatedAtTenHertz) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  int words = 0;
  for (int i = 0; i < 1000; ++i) {
    bench.tick();
    words += static_cast<int>(bench.sent(0x301).size());
  }
  EXPECT_EQ(words, 10);
}

TEST(BridgeShutdown, DampsThenSwitchesOff) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  for (int i = 0; i < 20; ++i) {
    bench.drives[0].position_counts += 2086;
    bench.tick();
  }
  bench.bridge->begin_shutdown(bench.time_us);
  bench.drives[0].position_counts += 2086;
  bench.tick();
  EXPECT_GT(bench.enabled(), 0);
  EXPECT_LT(bench.drives[0].target_torque_permille, -300);
  EXPECT_FALSE(bench.bridge->shut_down());
  for (int i = 0; i < 1000 && !bench.bridge->shut_down(); ++i) bench.tick();
  EXPECT_TRUE(bench.bridge->shut_down());
  EXPECT_EQ(bench.enabled(), 0);
  EXPECT_EQ(bench.ask(OperatorKind::kClear).outcome, OperatorOutcome::kRefused);
}

TEST(BridgeShutdown, OfAStandingRobotLetsItSinkDamped) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.run(100);
  bench.bridge->begin_shutdown(bench.time_us);
  bench.run(5);
  for (int i = 0; i < 200; ++i) {
    bench.drives[0].position_counts -= 2086;  // 1 rad/s
    bench.tick();
    ASSERT_GT(bench.enabled(), 0) << "dropped after " << i << " ms";
  }
  EXPECT_GT(bench.drives[0].target_torque_permille, 300);
}

TEST(BridgeShutdown, EndsThoughADriveObeysNoStop) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.drives[0].stuck_on = true;
  bench.bridge->begin_shutdown(bench.time_us);
  bench.run(1990);
  EXPECT_FALSE(bench.bridge->shut_down());
  bench.run(20);
  EXPECT_TRUE(bench.bridge->shut_down());
}

TEST(BridgeShutdown, WhileBootingIsImmediate) {
  BridgeBench bench;
  bench.tick();
  EXPECT_FALSE(bench.bridge->shut_down());
  bench.bridge->begin_shutdown(bench.time_us);
  EXPECT_TRUE(bench.bridge->shut_down());
}

}  // namespace
}  // namespace sprung
