// A robot whose nodes have no heartbeat: what the bridge writes, asks, and does when no answer comes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/canopen/objects.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;

RobotConfig guarded_robot() {
  RobotConfig robot = test::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) actuator.watch = NodeWatch::kGuarding;
  return robot;
}

class Guarding : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(bench_.boot());
    bench_.enable();
    ASSERT_EQ(bench_.enabled(), 2);
  }
  int remote_frames(std::uint32_t id) const {
    const std::vector<CanFrame> frames = bench_.sent(id);
    return static_cast<int>(
        std::count_if(frames.begin(), frames.end(), [](const CanFrame& f) { return f.remote; }));
  }
  const SafetyState& safety() const { return bench_.bridge->safety(); }

  test::BridgeBench bench_{guarded_robot()};
};

TEST_F(Guarding, NodeIsToldItsLifeTimeAndNoHeartbeat) {
  const test::FakeDrive& drive = bench_.drives[0];
  const double period_ms = 1e3 * bench_.robot.watchdogs.heartbeat_s;
  EXPECT_EQ(drive.objects.at({kGuardTime, 0}), static_cast<std::uint32_t>(period_ms));
  const double life_ms = period_ms * drive.objects.at({kLifeTimeFactor, 0});
  EXPECT_NEAR(life_ms, 1e3 * bench_.robot.watchdogs.heartbeat_consumer_s, period_ms);
  for (const CanFrame& frame : drive.received) {
    if (frame.id == kNmtId) continue;
    const ObjectId object = decode_sdo_request(frame).object;
    EXPECT_NE(object.index, kHeartbeatProducer) << "it may have none";
    EXPECT_NE(object.index, kHeartbeatConsumer);
  }
}

TEST_F(Guarding, EveryNodeIsAskedOnceAPeriod) {
  const int before = bench_.drives[0].guard_requests;
  int on_the_bus = 0;
  for (int i = 0; i < 1000; ++i) {
    bench_.tick();
    on_the_bus += remote_frames(heartbeat_id(1));
  }
  EXPECT_EQ(on_the_bus, 200);  // 5 ms
  EXPECT_EQ(bench_.drives[0].guard_requests - before, 200);
  EXPECT_EQ(safety().level, SafetyLevel::kOperational) << bench_.detail();
  EXPECT_EQ(bench_.bridge->bus_state().nodes[0].heartbeat_losses, 0);
}

TEST_F(Guarding, NothingButGuardingIsAskedForByRemoteFrames) {
  for (int i = 0; i < 200; ++i) {
    bench_.tick();
    for (const FrameBatch* batch : {&bench_.last_begin, &bench_.last_setpoints}) {
      for (const BusFrame& frame : *batch) {
        EXPECT_TRUE(!frame.frame.remote || (frame.frame.id & ~0x7FU) == kHeartbeatBase) << frame.frame.id;
      }
    }
  }
}

TEST_F(Guarding, MissingAnswersStopTheRobotAsMissingHeartbeatsDo) {
  bench_.drives[1].mute_guarding = true;
  bench_.run(150);
  EXPECT_EQ(safety().cause, SafetyCause::kDriveSilent);
  EXPECT_TRUE(safety().latched);
  EXPECT_THAT(bench_.detail(), HasSubstr("no answer to node guarding"));
  EXPECT_EQ(bench_.bridge->bus_state().nodes[1].heartbeat_losses, 1);
  bench_.run(800);
  EXPECT_EQ(bench_.enabled(), 0);
  bench_.drives[1].mute_guarding = false;
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  bench_.enable();
  EXPECT_EQ(bench_.enabled(), 2);
}

TEST_F(Guarding, ToggleBitThatStandsCountsAsNoAnswer) {
  bench_.drives[1].stuck_toggle = true;
  bench_.run(150);
  EXPECT_EQ(safety().cause, SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.detail(), HasSubstr("toggle bit"));
  EXPECT_GT(bench_.bridge->bus_state().nodes[1].heartbeat_losses, 10);
}

TEST_F(Guarding, OneLostAnswerIsNothing) {
  bench_.drives[1].mute_guarding = true;
  bench_.run(6);
  bench_.drives[1].mute_guarding = false;
  bench_.run(500);
  EXPECT_EQ(safety().level, SafetyLevel::kOperational) << bench_.detail();
}

TEST_F(Guarding, DriveThatRestartsIsSeen) {
  bench_.drives[1].restart_now = true;
  bench_.run(20);
  EXPECT_EQ(safety().cause, SafetyCause::kDriveSilent);
  EXPECT_EQ(bench_.bridge->bus_state().nodes[1].boot_ups, 1);
}

// Its own watch is the last thing that stops a drive that obeys nothing else (stop_watch.h).
TEST_F(Guarding, DriveThatObeysNoStopIsNotAskedForHalfASecond) {
  bench_.drives[1].stuck_on = true;
  bench_.drives[1].boots_silently = true;
  bench_.ask(OperatorKind::kEstop);
  int longest_pause = 0, pause = 0, asked = bench_.drives[1].guard_requests;
  const int other = bench_.drives[0].guard_requests;
  for (int i = 0; i < 2000; ++i) {
    bench_.tick();
    pause = bench_.drives[1].guard_requests == asked ? pause + 1 : 0;
    asked = bench_.drives[1].guard_requests;
    longest_pause = std::max(longest_pause, pause);
  }
  EXPECT_GE(longest_pause, 500);
  EXPECT_EQ(bench_.drives[0].guard_requests - other, 400) << "the others are asked all the time";
}

}  // namespace
}  // namespace sprung
