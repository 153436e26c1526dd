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

/// EC 90 flat, 50:1: 10.85 Nm are 1 A and 2.3 V, 1 rad/s is 10.85 V.
TEST(VoltageReserve, FollowsFromTorqueAndSpeedOfTheTruth) {
  const RobotConfig robot = load_robot("pegasus");
  VoltageReserveWatch watch(robot, {});
  SimTruth truth(robot.joints.size(), robot.legs.size());
  for (TrueJoint& joint : truth.joints) joint.true_motor_torque_Nm = joint.true_velocity_rad_s = 0.0;
  truth.joints[5].true_motor_torque_Nm = 2.0 * 10.85;
  truth.joints[5].true_velocity_rad_s = 2.0;
  watch.add(truth);
  EXPECT_NEAR(watch.result().least, 1.0 - (4.6 + 21.7) / 43.2, 1e-9);
  EXPECT_EQ(watch.result().actuator, robot.actuators[5].name);
}

TEST(VoltageReserve, OfTheTruthLeavesOutActuatorsThatTurnSeveralJoints) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  VoltageReserveWatch watch(robot, {});
  SimTruth truth(robot.joints.size(), robot.legs.size());
  for (TrueJoint& joint : truth.joints) joint.true_motor_torque_Nm = joint.true_velocity_rad_s = 1.0;
  watch.add(truth);
  EXPECT_TRUE(std::isnan(watch.result().least));
}

}  // namespace
}  // namespace sprung
