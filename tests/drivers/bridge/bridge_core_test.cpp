#include "drivers/bridge/bridge_core.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "tests/support/allocation_count.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using test::BridgeBench;
using test::FakeDrive;
using test::two_drive_robot;
using ::testing::HasSubstr;

TEST(BridgeCore, UnknownProfileIsRefusedAtOnce) {
  RobotConfig robot = two_drive_robot();
  robot.actuators[1].profile = "silver";
  try {
    const BridgeCore bridge(robot, {});
    FAIL() << "accepted an unknown profile";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no drive profile 'silver'; there are: "));
  }
}

TEST(BridgeCore, SyncIsTheLastFrameOfEveryTickOnEveryBus) {
  RobotConfig robot = two_drive_robot();
  robot.buses.push_back({"other", "memory:other"});
  BridgeBench bench(robot);
  for (int i = 0; i < 200; ++i) {
    bench.tick();
    const int size = bench.last_begin.size();
    ASSERT_GE(size, 2);
    for (int bus = 0; bus < 2; ++bus) {
      EXPECT_EQ(bench.last_begin[size - 2 + bus].frame, canopen::sync_frame());
      EXPECT_EQ(bench.last_begin[size - 2 + bus].bus, bus);
    }
  }
}

TEST(BridgeCore, HeartbeatOfNode127NeverPausesLongerThanItsPeriod) {
  BridgeBench bench;
  std::int64_t last_us = 0;
  for (int i = 0; i < 500; ++i) {
    bench.tick();
    if (bench.sent(0x77F).empty()) continue;
    EXPECT_LE(bench.time_us - last_us, 5000);
    last_us = bench.time_us;
  }
  EXPECT_GE(last_us, 495000);
}

TEST(BridgeCore, CycleZeroIsTheFirstSyncThatAllDrivesAnswer) {
  BridgeBench bench;
  EXPECT_FALSE(bench.bridge->operational());
  ASSERT_TRUE(bench.boot());
  EXPECT_EQ(bench.state.stamp.seq, 0);
  EXPECT_EQ(bench.state.stamp.utime_us, bench.time_us);
  bench.tick();
  EXPECT_EQ(bench.state.stamp.seq, 1);
  EXPECT_STREQ(bench.bridge->boot_detail(), "all drives operational");
}

TEST(BridgeCore, NoDriveIsStartedBeforeAllAreConfigured) {
  BridgeBench bench;
  bench.drives[1].dead = true;
  bench.run(1500);
  EXPECT_EQ(bench.drives[0].nmt, canopen::NmtState::kPreOperational);
  EXPECT_THAT(bench.bridge->boot_detail(), HasSubstr("knee_motor: node 2 does not answer"));
  bench.drives[1].dead = false;
  EXPECT_TRUE(bench.boot());
}

TEST(BridgeCore, MeasuredValuesAreInActuatorSpace) {
  BridgeBench bench;
  bench.drives[0].position_counts = 131072 * 25;  // a quarter turn of the output
  bench.drives[1].position_counts = 131072 * 25;
  ASSERT_TRUE(bench.boot());
  bench.drives[1].torque_permille = 500;
  bench.tick();
  EXPECT_NEAR(bench.state.actuators[0].measured_position_rad, std::acos(0.0) + 0.1, 1e-9);
  EXPECT_NEAR(bench.state.actuators[1].measured_position_rad, -std::acos(0.0) + 0.1, 1e-9);
  EXPECT_NEAR(bench.state.actuators[1].measured_current_A, -3.5, 1e-9);
  EXPECT_TRUE(std::isnan(bench.state.actuators[0].measured_velocity_rad_s));
  EXPECT_TRUE(std::isnan(bench.state.actuators[0].measured_link_position_rad));
}

TEST(BridgeCore, SupplyVoltageIsUnknownUntilReadInTheBackground) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  EXPECT_TRUE(std::isnan(bench.state.actuators[0].measured_supply_V));
  bench.run(100);
  EXPECT_DOUBLE_EQ(bench.state.actuators[0].measured_supply_V, 48.0);
  bench.drives[0].objects[{canopen::kSupplyVoltage, 0}] = 36000;
  bench.run(1100);
  EXPECT_DOUBLE_EQ(bench.state.actuators[0].measured_supply_V, 36.0);
}

TEST(BridgeCore, FaultAtStartIsResetWithoutAnybodysHelp) {
  BridgeBench bench;
  bench.drives[0].power = PowerState::kFault;
  ASSERT_TRUE(bench.boot());
  bench.run(100);
  EXPECT_EQ(bench.drives[0].power, PowerState::kSwitchOnDisabled);
  EXPECT_EQ(bench.bridge->safety().latched, false);
}

TEST(BridgeCore, MotionRequestsAreNotTheBridges) {
  BridgeBench bench;
  EXPECT_EQ(bench.ask(OperatorKind::kJump).outcome, OperatorOutcome::kRefused);
}

TEST(BridgeCore, StepsAllocateNothingAfterConstruction) {
  const RobotConfig robot = two_drive_robot();
  BridgeCore bridge(robot, {robot.watchdogs});
  DriveState state(2);
  DriveCommand command(2);
  FrameBatch out;
  CanFrame sample = canopen::heartbeat_frame(1, canopen::NmtState::kBootUp);
  const std::int64_t before = test::allocation_count();
  for (int i = 1; i < 3000; ++i) {
    const std::int64_t time_us = 1000 * i;
    out.clear();
    bridge.begin_tick(time_us, out);
    for (const BusFrame& item : out) {
      if (item.frame.id != 0x601) continue;
      const canopen::SdoMessage request = canopen::decode_sdo_request(item.frame);
      const bool read = request.kind == canopen::SdoKind::kUpload;
      bridge.receive(0,
                     read ? canopen::sdo_read_reply(1, request.object, 0x9A, 4)
                          : canopen::sdo_write_reply(1, request.object),
                     time_us);
    }
    bridge.receive(0, sample, time_us);
    bridge.end_sampling(time_us, state);
    bridge.command(command, time_us);
    bridge.emit_setpoints(time_us, out);
    bridge.safety();
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(BridgeCore, HealthyCyclesAllocateNothing) {
  BridgeBench bench;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.command_all(DriveMode::kTorque, 5.0);
  std::int64_t allocations = 0;
  const auto count = [&allocations](auto&& step) {  // the drives may allocate, the bridge may not
    const std::int64_t before = test::allocation_count();
    step();
    allocations += test::allocation_count() - before;
  };
  FrameBatch out;
  std::vector<CanFrame> answers;
  for (int i = 0; i < 1000; ++i) {
    bench.time_us += 1000;
    out.clear();
    count([&] { bench.bridge->begin_tick(bench.time_us, out); });
    answers.clear();
    for (FakeDrive& drive : bench.drives) {
      for (const BusFrame& item : out) drive.receive(item.frame, answers);
      drive.tick(bench.time_us, answers);
    }
    ASSERT_GE(answers.size(), 2U);
    out.clear();
    count([&] {
      for (const CanFrame& frame : answers) bench.bridge->receive(0, frame, bench.time_us);
      bench.bridge->end_sampling(bench.time_us, bench.state);
      bench.command.stamp = bench.state.stamp;
      bench.command.valid_until_utime_us = bench.time_us + 21000;
      bench.bridge->command(bench.command, bench.time_us);
      bench.bridge->emit_setpoints(bench.time_us, out);
      bench.bridge->safety();
    });
    for (FakeDrive& drive : bench.drives) {
      for (const BusFrame& item : out) drive.receive(item.frame, answers);
    }
    ASSERT_EQ(bench.state.safety, SafetyLevel::kOperational);
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(bench.drives[0].target_torque_permille, 162);
}

void expect_same(const FrameBatch& first, const FrameBatch& second) {
  ASSERT_EQ(first.size(), second.size());
  for (int i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].bus, second[i].bus);
    EXPECT_EQ(first[i].frame, second[i].frame);
  }
}

TEST(BridgeCore, SameInputsGiveTheSameFrames) {
  BridgeBench first, second;
  for (int i = 0; i < 600; ++i) {
    for (BridgeBench* bench : {&first, &second}) {
      bench->command_all(i > 300 ? DriveMode::kTorque : DriveMode::kDisabled, 3.7);
      bench->drives[0].position_counts = i * i;
      bench->tick();
    }
    expect_same(first.last_begin, second.last_begin);
    expect_same(first.last_setpoints, second.last_setpoints);
    ASSERT_FALSE(HasFailure()) << "tick " << i;
  }
  EXPECT_GT(first.enabled(), 0) << "the comparison has reached torque";
}

}  // namespace
}  // namespace sprung
