#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/bridge/bus_load_check.h"
#include "robots/robot_loader.h"

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
  try {
    check_bus_load(robot, report_of(robot));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was refused";
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
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "bridge's heartbeat"), 65 * 200.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card TPDO1"), 135 * 500.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card background reads"), 270.0);
  EXPECT_DOUBLE_EQ(bits_per_s(bus, "fl_card emergencies"), 1350.0);
  double sum = 0.0;
  for (const BusContribution& part : bus.contributions) sum += part.bits_per_s;
  EXPECT_NEAR(bus.share, sum / 1e6, 1e-12);
  EXPECT_NEAR(bus.share, 0.68848, 1e-9);
}

TEST(BusLoad, ShippedRobotsFit) {
  for (const char* name : {"pegasus", "single_leg"}) {
    const RobotConfig robot = load_robot(name);
    EXPECT_EQ(refusal(robot), "nothing was refused");
    for (const BusLoad& bus : report_of(robot).buses) EXPECT_GT(bus.share, 0.5) << name;
  }
}

TEST(BusLoad, PegasusAtAThousandHertzIsRefusedWithTheRemedy) {
  RobotConfig robot = load_robot("pegasus");
  robot.cycle_s = 0.001;
  EXPECT_THAT(refusal(robot),
              AllOf(HasSubstr("bus fl: 129 %"), HasSubstr("97.0 % in every cycle"), HasSubstr("TPDO1 13.5 %"),
                    HasSubstr("Lower cycle_rate"), HasSubstr("80 %")));
}

TEST(BusLoad, ASlowerBusIsFuller) {
  RobotConfig robot = load_robot("pegasus");
  const double share = report_of(robot).buses[2].share;
  robot.bit_rate_bit_s = 8e5;
  EXPECT_NEAR(report_of(robot).buses[2].share, share / 0.8, 1e-12);
  EXPECT_THAT(refusal(robot), HasSubstr("bus fl: 86 %"));
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
  // 5 heartbeats of 65 bits, at 20 instead of 200 a second.
  EXPECT_NEAR(report_of(robot).buses[0].share - bus_load(robot, slow).buses[0].share, 5 * 65 * 180e-6, 1e-12);
}

TEST(BusLoad, LargestContributionsComeFirst) {
  const BusLoad bus = report_of(load_robot("single_leg")).buses[0];
  for (std::size_t i = 1; i < bus.contributions.size(); ++i)
    EXPECT_GE(bus.contributions[i - 1].bits_per_s, bus.contributions[i].bits_per_s);
}

}  // namespace
}  // namespace sprung
