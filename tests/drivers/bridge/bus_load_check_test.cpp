#include "drivers/bridge/bus_load_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/bridge/bridge_core.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

BusLoadReport report_of(const RobotConfig& robot) { return bus_load(robot, robot.watchdogs); }

double bits_per_s(const BusLoad& bus, const std::string& what) {
  for (const BusContribution& part : bus.contributions) {
    if (part.what == what) return part.bits_per_s;
  }
  ADD_FAILURE() << "nothing is called " << what;
  return 0.0;
}

std::string refusal(const RobotConfig& robot) {
  return test::refusal_of([&] { check_bus_load(robot, report_of(robot)); });
}

TEST(BusLoad, CyclicPartOfPegasusIsThatOfTheFacts) {
  const RobotConfig robot = load_robot("pegasus");
  const BusLoadReport report = report_of(robot);
  ASSERT_EQ(report.buses.size(), 4U);
  for (const BusLoad& bus : report.buses) {
    EXPECT_DOUBLE_EQ(bus.cyclic_bits, 970.0)
        << bus.bus;  // design section 5: SYNC, 3 x (8 + 7 bytes), card 8 bytes
    EXPECT_THAT(bus_load_text(robot, bus), HasSubstr("48.5 % in every cycle"));
  }
}

TEST(BusLoad, EveryFrameIsCountedAtItsWorstRate) {
  const BusLoad bus = report_of(load_robot("pegasus")).buses[0];
  EXPECT_EQ(bus.bus, "fl");
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "SYNC"), 55 * 500.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor TPDO1"), 135 * 500.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor RPDO1"), 125 * 500.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor RPDO2"), 75 * 500.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor TPDO2"), 65 * 100.0);  // inhibit 10 ms
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor heartbeat"), 65 * 200.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "bridge's heartbeat"),
                   65 * 250.0);  // every second cycle: 5 ms would be late
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card TPDO1"), 135 * 500.0);
  // Supply once a second; mode every 50 ms while the drive does not show it.
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor background reads"), 270.0 * 21);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card emergencies"), 1350.0);
  double sum = 0.0;
  for (const BusContribution& part : bus.contributions) sum += part.bits_per_s;
  EXPECT_NEAR(bus.share, sum / 1e6, 1e-12);
  EXPECT_NEAR(bus.share, 0.70766, 1e-9);
}

TEST(BusLoad, GuardedNodeHasQuestionAndAnswerInWholeCycles) {
  RobotConfig robot = load_robot("pegasus");
  robot.actuators[1].watch = NodeWatch::kGuarding;
  robot.encoder_cards[0].watch = NodeWatch::kGuarding;
  const BusLoad bus = report_of(robot).buses[0];
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_hip_motor guarding"), (55 + 65) * 250.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card guarding"), (55 + 65) * 250.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_knee_motor heartbeat"), 65 * 200.0);
}

double bridge_heartbeats_per_s(double cycle_s, double heartbeat_s) {
  RobotConfig robot = load_robot("single_leg");
  robot.cycle_s = cycle_s;
  robot.watchdogs.heartbeat_s = heartbeat_s;
  return bits_per_s(report_of(robot).buses[0], "bridge's heartbeat") / 65.0;
}

// As many as BridgeCore sends: rather early than late, and never more than one in a cycle.
TEST(BusLoad, BridgesHeartbeatComesInWholeCycles) {
  EXPECT_NEAR(bridge_heartbeats_per_s(0.002, 0.005), 250.0, 1e-9);
  EXPECT_NEAR(bridge_heartbeats_per_s(0.001, 0.005), 200.0, 1e-9);
  EXPECT_NEAR(bridge_heartbeats_per_s(0.0025, 0.005), 200.0, 1e-9);
  EXPECT_NEAR(bridge_heartbeats_per_s(0.004, 0.001), 250.0, 1e-9);
}

TEST(BusLoad, BridgesHeartbeatIsCountedAsItIsSent) {
  for (const double heartbeat_s : {0.005, 0.0041, 0.002, 0.001}) {
    RobotConfig robot = load_robot("single_leg");
    robot.cycle_s = 0.002;
    robot.watchdogs.heartbeat_s = heartbeat_s;
    BridgeCore bridge(robot, BridgeOptions{robot.watchdogs});
    FrameBatch out;
    int heartbeats = 0;
    for (std::int64_t time_us = 0; time_us < 1'000'000; time_us += 2000) {
      out.clear();
      bridge.begin_tick(time_us, out);
      for (const BusFrame& f : out) heartbeats += f.frame.id == canopen::heartbeat_id(canopen::kBridgeNode);
    }
    const double counted = bits_per_s(report_of(robot).buses[0], "bridge's heartbeat") / 65.0;
    EXPECT_NEAR(heartbeats, counted, 1.0) << heartbeat_s;
  }
}

TEST(BusLoad, ShippedRobotsFit) {
  for (const char* name : {"pegasus", "single_leg"}) {
    const RobotConfig robot = load_robot(name);
    EXPECT_EQ(refusal(robot), "not refused");
    for (const BusLoad& bus : report_of(robot).buses) EXPECT_GT(bus.share, 0.5) << name;
  }
}

TEST(BusLoad, PegasusAtAThousandHertzIsRefusedWithTheRemedy) {
  RobotConfig robot = load_robot("pegasus");
  robot.cycle_s = 0.001;
  EXPECT_THAT(refusal(robot),
              AllOf(HasSubstr("bus fl: 130 %"), HasSubstr("97.0 % in every cycle"), HasSubstr("TPDO1 13.5 %"),
                    HasSubstr("Lower cycle_rate"), HasSubstr("80 %")));
}

TEST(BusLoad, ASlowerBusIsFuller) {
  RobotConfig robot = load_robot("pegasus");
  const double share = report_of(robot).buses[2].share;
  robot.bit_rate_bit_s = 8e5;
  EXPECT_NEAR(report_of(robot).buses[2].share, share / 0.8, 1e-12);
  EXPECT_THAT(refusal(robot), HasSubstr("bus fl: 88 %"));
}

TEST(BusLoad, OnlyTheBusThatIsTooFullIsNamed) {
  RobotConfig robot = load_robot("pegasus");
  ActuatorConfig fourth = robot.actuators[6];  // on hl
  fourth.node = 9;
  robot.actuators.push_back(fourth);
  EXPECT_THAT(refusal(robot), AllOf(HasSubstr("bus hl"), HasSubstr("move a node")));
}

TEST(BusLoad, SlowerHeartbeatsLightenIt) {
  const RobotConfig robot = load_robot("pegasus");
  WatchdogConfig slow = robot.watchdogs;
  slow.heartbeat_s = 0.050;
  // 4 heartbeats of 65 bits at 20 instead of 200 a second, the bridge's instead of 250.
  EXPECT_NEAR(report_of(robot).buses[0].share - bus_load(robot, slow).buses[0].share,
              65 * (4 * 180e-6 + 230e-6), 1e-12);
}

TEST(BusLoad, LargestContributionsComeFirst) {
  const BusLoad bus = report_of(load_robot("single_leg")).buses[0];
  for (std::size_t i = 1; i < bus.contributions.size(); ++i)
    EXPECT_GE(bus.contributions[i - 1].bits_per_s, bus.contributions[i].bits_per_s);
}

}  // namespace
}  // namespace sprung
