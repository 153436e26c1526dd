// What a bus can do to the bridge: its reaction, its name and its counter.
#include <gmock/gmock.h>

#include "drivers/canopen/objects.h"
#include "tests/drivers/bridge/faults_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;

TEST_F(BridgeFaults, HealthyRobotCountsFramesAndNothingElse) {
  bench_.run(1100);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  EXPECT_GT(bus().sent, 3000);
  EXPECT_GT(bus().received, 2000);
  EXPECT_EQ(bus().unexpected + bus().error_frames + bus().bus_offs, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeHealth& node = health(i);
    EXPECT_EQ(node.missing_samples + node.late_samples + node.short_frames + node.duplicate_samples, 0);
    EXPECT_EQ(node.heartbeat_losses + node.boot_ups + node.emergencies + node.sdo_failures +
                  node.implausible_samples,
              0);
    EXPECT_EQ(node.nmt_state, 5);
    EXPECT_TRUE(node.operational);
    EXPECT_EQ(node.node, static_cast<int>(i) + 1);
    EXPECT_EQ(node.actuator, static_cast<int>(i));
  }
}

TEST_F(BridgeFaults, LoadIsTheWorstCaseOfAllFrames) {
  bench_.run(2100);
  // A cycle: SYNC, two samples of 8 bytes, two set-points of 7; heartbeats every 5 ms; control words at 10
  // Hz.
  const double bits_per_cycle = 55 + 2 * 135 + 2 * 125 + 3 * 65 / 5.0 + 2 * 75 / 100.0;
  EXPECT_NEAR(bus().load_share, bits_per_cycle * 1000 / 1e6, 0.005);
}

TEST_F(BridgeFaults, BusOffLosesTheBusAndComesBack) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  bench_.tick();
  expect_bus_lost("it is off");
  EXPECT_EQ(bus().bus_offs, 1);
  EXPECT_EQ(bus().error_frames, 1);
  expect_cleared();
}

TEST_F(BridgeFaults, BusOffOfOneBusStopsTheOthersToo) {
  RobotConfig robot = test::two_drive_robot();
  robot.buses.push_back({"spare", "memory:spare"});
  test::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.bridge->receive(1, bus_lost_frame(), bench.time_us);
  bench.tick();
  EXPECT_EQ(bench.drives[0].power, PowerState::kQuickStopActive);
  EXPECT_THAT(bench.detail(), HasSubstr("bus spare"));
  EXPECT_EQ(bench.bridge->bus_state().buses[1].condition, BusCondition::kOff);
  EXPECT_EQ(bench.bridge->bus_state().buses[0].condition, BusCondition::kActive);
}

TEST_F(BridgeFaults, ErrorPassiveLosesTheBusUntilTheControllerIsActiveAgain) {
  controller_error(0x10);
  bench_.tick();
  expect_bus_lost("it is error passive");
  EXPECT_EQ(bus().condition, BusCondition::kPassive);
  bench_.run(700);
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("error passive"));
  controller_error(0x40);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  expect_cleared();
}

TEST_F(BridgeFaults, ErrorPassiveWithoutNewErrorsForbidsClear) {
  controller_error(0x20);
  bench_.run(1500);
  EXPECT_EQ(bus().condition, BusCondition::kPassive);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kRefused);
}

TEST_F(BridgeFaults, ControlWordsOfACycleThatDidNotGoOutAreSentAgain) {
  bench_.tick();
  ASSERT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
  bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
  bench_.tick();
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(1, 1)).size(), 1U);
  bench_.tick();
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
}

TEST_F(BridgeFaults, ErrorWarningIsShownAndStopsNobody) {
  controller_error(0x08);
  bench_.run(5);
  EXPECT_EQ(bus().condition, BusCondition::kWarning);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, FullSendQueueIsTroubleOnlyWhenItLasts) {
  for (int cycles = 0; cycles < 2; ++cycles) {
    bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
    bench_.tick();
    EXPECT_EQ(bus().condition, BusCondition::kNoBuffers);
    EXPECT_EQ(level(), SafetyLevel::kOperational);
  }
  bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
  bench_.tick();
  expect_bus_lost("send queue full");
  bench_.run(2);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  expect_cleared();
}

TEST_F(BridgeFaults, SingleFullQueuesAreNoTrouble) {
  for (int i = 0; i < 20; ++i) {
    if (i % 3 != 0) bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
    bench_.tick();
    ASSERT_EQ(level(), SafetyLevel::kOperational);
  }
}

TEST_F(BridgeFaults, LinkDownLosesTheBusAtOnce) {
  bench_.bridge->send_failed(0, SendFailure::kLinkDown, bench_.time_us);
  EXPECT_EQ(bus().condition, BusCondition::kLinkDown);
  bench_.tick();
  expect_bus_lost("link down");
  for (int i = 0; i < 700; ++i) {
    bench_.bridge->send_failed(0, SendFailure::kLinkDown, bench_.time_us);
    bench_.tick();
  }
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("ip link set INTERFACE up"));
  expect_cleared();
}

TEST_F(BridgeFaults, ReceiveQueueThatOverflowedIsCounted) {
  bench_.bridge->set_traffic(0, {7, 3, 12, 1});
  EXPECT_EQ(bus().send_failed, 7);
  EXPECT_EQ(bus().no_buffers, 3);
  EXPECT_EQ(bus().dropped, 12);
  EXPECT_EQ(bus().malformed, 1);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, FramesOfStrangersAreCountedAndIgnored) {
  const std::int64_t before = bus().received;
  for (const std::uint32_t id : {0x183U, 0x705U, 0x583U, 0x601U, 0x381U, 0x77FU}) {
    CanFrame frame;
    frame.id = id;
    frame.length = 8;
    bench_.bridge->receive(0, frame, bench_.time_us);
  }
  EXPECT_EQ(bus().unexpected, 6);
  EXPECT_EQ(bus().received, before + 6);
  bench_.run(3);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, SamplesThatAreTooShortCountAsMissing) {
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) { frames[i].length = 7; });
  bench_.run(2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.tick();
  EXPECT_EQ(health(0).short_frames, 3);
  EXPECT_EQ(health(0).missing_samples, 3);
  expect_damping(SafetyCause::kDriveSilent, "hip_motor: did not answer SYNC for 3 cycles");
  expect_cleared();
}

}  // namespace
}  // namespace sprung
