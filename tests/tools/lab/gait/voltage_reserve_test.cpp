#include "tools/lab/gait/voltage_reserve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(VoltageReserve, IsTheLeastOfAllActuatorsAndCyclesInBothDirections) {
  const RobotConfig robot = load_robot("pegasus");
  VoltageReserveWatch watch(robot, {});
  EXPECT_TRUE(std::isnan(watch.result().least)) << "nothing was seen yet";
  watch.add(2, 21.6, 48.0);
  EXPECT_NEAR(watch.result().least, 0.5, 1e-12);
  watch.add(4, -32.4, 48.0);
  EXPECT_NEAR(watch.result().least, 0.25, 1e-12);
  EXPECT_EQ(watch.result().actuator, robot.actuators[4].name);
  watch.add(1, 10.0, 48.0);
  EXPECT_NEAR(watch.result().least, 0.25, 1e-12);
  watch.add(1, 50.0, 48.0);
  EXPECT_LT(watch.result().least, 0.0) << "more than there is";
}

TEST(VoltageReserve, LowerSupplyLeavesLess) {
  VoltageReserveWatch watch(load_robot("pegasus"), {});
  watch.add(0, 21.6, 40.0);
  EXPECT_NEAR(watch.result().least, 0.4, 1e-12);
}

/// R i + Ke w of a robot that lies still is 0: all is left.
TEST(VoltageReserve, IsWholeWhereNothingMoves) {
  const RobotConfig robot = load_robot("pegasus");
  SimCore sim(robot, {});
  VoltageReserveWatch watch(robot, {});
  watch.add(sim);
  EXPECT_EQ(watch.result().least, 1.0);
}

}  // namespace
}  // namespace sprung
