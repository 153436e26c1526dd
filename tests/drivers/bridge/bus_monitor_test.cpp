// Condition, counters and load of each bus; what the bridge does about them is in faults_test.cpp.
#include "drivers/bridge/bus_monitor.h"

#include <gmock/gmock.h>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/nmt.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

class BusMonitorTest : public ::testing::Test {
 protected:
  BusMonitorTest() : robot_(two_buses()), monitor_(robot_, robot_.watchdogs) { cycle(); }
  static RobotConfig two_buses() {
    RobotConfig robot = test::two_drive_robot();
    robot.buses.push_back({"spare", "memory:spare"});
    return robot;
  }
  void cycle() {
    time_us_ += 1000;
    monitor_.begin_cycle(time_us_);
  }
  void tell(const CanFrame& frame) { monitor_.error_frame(0, frame); }
  void tell(std::uint32_t error_class, std::uint8_t controller_detail = 0) {
    CanFrame frame = bus_lost_frame();
    frame.id = error_class;
    frame.data[1] = controller_detail;
    tell(frame);
  }
  const BusHealth& health() const { return monitor_.health(0); }
  BusCondition condition() const { return health().condition; }
  std::string detail() const { return monitor_.fault() != nullptr ? monitor_.fault()->detail.data() : ""; }

  RobotConfig robot_;
  BusMonitor monitor_;
  std::int64_t time_us_ = 0;
};

TEST_F(BusMonitorTest, BusOffIsCountedWhenItBeginsAndNotForEveryFrame) {
  for (int i = 0; i < 5; ++i) {
    tell(bus_lost_frame());
    cycle();
  }
  EXPECT_EQ(health().bus_offs, 1);
  EXPECT_EQ(health().error_frames, 5);
  EXPECT_EQ(condition(), BusCondition::kOff);
  tell(kCanErrorRestarted);
  EXPECT_EQ(condition(), BusCondition::kActive);
  EXPECT_EQ(health().restarts, 1);
  tell(bus_lost_frame());
  EXPECT_EQ(health().bus_offs, 2);
}

TEST_F(BusMonitorTest, FrameThatArrivesEndsBusOffToo) {
  tell(bus_lost_frame());
  monitor_.received(0, canopen::heartbeat_frame(1, canopen::NmtState::kOperational), true);
  EXPECT_EQ(condition(), BusCondition::kActive);
  EXPECT_FALSE(monitor_.any_lost());
  EXPECT_NE(monitor_.fault(), nullptr) << "that it was lost stays trouble";
}

TEST_F(BusMonitorTest, LinkThatIsDownIsNoBusOffAndEndsWithIt) {
  for (int i = 0; i < 5; ++i) {
    tell(link_down_frame());
    EXPECT_EQ(condition(), BusCondition::kLinkDown);
    EXPECT_TRUE(monitor_.lost(0));
    cycle();
  }
  EXPECT_EQ(health().bus_offs, 0);
  EXPECT_EQ(health().no_buffers, 0);
  EXPECT_THAT(detail(), HasSubstr("bus leg (memory:leg) is lost: it has no link (link down)"));
  EXPECT_THAT(monitor_.what_to_mend(), HasSubstr("ip link set INTERFACE up"));
  cycle();
  EXPECT_EQ(condition(), BusCondition::kActive);
  EXPECT_EQ(monitor_.what_to_mend(), nullptr);
}

TEST_F(BusMonitorTest, TransmitTimeOutOfAControllerIsNoDeadLink) {
  tell(kCanErrorTxTimeout);
  EXPECT_EQ(condition(), BusCondition::kNoBuffers);
  EXPECT_THAT(detail(), HasSubstr("transmit time-out"));
}

TEST_F(BusMonitorTest, FullQueueIsALossOnlyWhenItLasts) {
  for (int i = 0; i < robot_.watchdogs.silent_cycles; ++i) {
    tell(queue_full_frame());
    EXPECT_EQ(condition(), BusCondition::kNoBuffers);
    EXPECT_FALSE(monitor_.lost(0)) << i;
    cycle();
  }
  tell(queue_full_frame());
  EXPECT_TRUE(monitor_.lost(0));
  EXPECT_EQ(health().bus_offs, 0);
  EXPECT_THAT(monitor_.what_to_mend(), HasSubstr("takes no frames"));
}

TEST_F(BusMonitorTest, WarningIsShownAndPassiveIsALoss) {
  tell(kCanErrorController, 0x08);
  EXPECT_EQ(condition(), BusCondition::kWarning);
  EXPECT_FALSE(monitor_.any_lost());
  tell(kCanErrorController, 0x20);
  EXPECT_EQ(condition(), BusCondition::kPassive);
  EXPECT_TRUE(monitor_.lost(0));
  tell(kCanErrorController, 0x40);
  EXPECT_EQ(condition(), BusCondition::kActive);
  EXPECT_FALSE(monitor_.any_lost());
}

TEST_F(BusMonitorTest, PassiveStaysUntilTheControllerSaysOtherwise) {
  tell(kCanErrorController, 0x10);
  for (int i = 0; i < 3000; ++i) cycle();
  EXPECT_EQ(condition(), BusCondition::kPassive) << "kernels tell the change only";
  EXPECT_TRUE(monitor_.lost(0));
  tell(kCanErrorController, 0x08);
  EXPECT_EQ(condition(), BusCondition::kWarning);
  EXPECT_FALSE(monitor_.lost(0));
}

TEST_F(BusMonitorTest, FullQueueThatIsOverLeavesAPassiveControllerPassive) {
  tell(kCanErrorController, 0x10);
  monitor_.send_failed(0, SendFailure::kNoBuffers);
  EXPECT_EQ(condition(), BusCondition::kNoBuffers);
  cycle();
  EXPECT_TRUE(monitor_.sending_failed(0));
  cycle();
  EXPECT_FALSE(monitor_.sending_failed(0));
  EXPECT_EQ(condition(), BusCondition::kPassive);
  EXPECT_TRUE(monitor_.lost(0));
}

TEST_F(BusMonitorTest, InterfaceThatWasSetDownAndUpIsNotPassiveAnyMore) {
  tell(kCanErrorController, 0x10);
  tell(link_down_frame());
  cycle();
  EXPECT_EQ(condition(), BusCondition::kLinkDown);
  cycle();
  EXPECT_EQ(condition(), BusCondition::kActive);
  EXPECT_FALSE(monitor_.lost(0));
}

TEST_F(BusMonitorTest, WorseConditionStaysUntilItIsOver) {
  tell(bus_lost_frame());
  tell(kCanErrorController, 0x30);
  tell(link_down_frame());
  EXPECT_EQ(condition(), BusCondition::kOff);
  EXPECT_THAT(monitor_.what_to_mend(), HasSubstr("restart-ms"));
}

TEST_F(BusMonitorTest, WorstLossIsRememberedUntilItIsForgotten) {
  EXPECT_EQ(monitor_.loss(0), nullptr);
  tell(kCanErrorController, 0x08);
  EXPECT_EQ(monitor_.loss(0), nullptr) << "a warning is none";
  tell(kCanErrorController, 0x10);
  EXPECT_STREQ(monitor_.loss(0), "bus was passive");
  tell(link_down_frame());
  EXPECT_STREQ(monitor_.loss(0), "bus had no link");
  tell(bus_lost_frame());
  tell(kCanErrorRestarted);
  EXPECT_STREQ(monitor_.loss(0), "bus was off");
  EXPECT_EQ(monitor_.loss(1), nullptr);
  monitor_.forget_losses();
  EXPECT_EQ(monitor_.loss(0), nullptr);
}

TEST_F(BusMonitorTest, TroubleNamesTheFirstLossOnce) {
  tell(bus_lost_frame());
  ASSERT_NE(monitor_.fault(), nullptr);
  EXPECT_EQ(monitor_.fault()->cause, SafetyCause::kBusLost);
  monitor_.forget_trouble();
  tell(bus_lost_frame());
  EXPECT_EQ(monitor_.fault(), nullptr);
}

TEST_F(BusMonitorTest, ReceiveOverflowIsCountedAsDropped) {
  tell(kCanErrorController, 0x01);
  EXPECT_EQ(health().dropped, 1);
  monitor_.set_traffic(0, {0, 0, 5, 0});
  EXPECT_EQ(health().dropped, 6) << "the controller's and the kernel's";
  EXPECT_EQ(condition(), BusCondition::kActive);
}

TEST_F(BusMonitorTest, LoadOfEachSecondIsWorstCaseBitsOfWhatPassed) {
  const CanFrame heartbeat = canopen::heartbeat_frame(1, canopen::NmtState::kOperational);
  for (int i = 0; i < 1000; ++i) {
    monitor_.sent(0, heartbeat);
    monitor_.received(0, heartbeat, i % 100 != 0);
    cycle();
  }
  EXPECT_DOUBLE_EQ(health().load_share, 1000 * 2 * 65 / robot_.bit_rate_bit_s);
  EXPECT_EQ(monitor_.health(1).load_share, 0.0);
  EXPECT_EQ(health().sent, 1000);
  EXPECT_EQ(health().received, 1000);
  EXPECT_EQ(health().unexpected, 10);
}

}  // namespace
}  // namespace sprung
