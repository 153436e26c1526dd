#include "tools/lab/gait/motor_windings.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// EC 90 flat, 50:1: 10.85 Nm are 1 A and 2.3 V, 1 rad/s is 10.85 V.
TEST(MotorWindings, VoltageAndPowerFollowFromTorqueAndSpeed) {
  const RobotConfig robot = load_robot("pegasus");
  const std::vector<MotorWinding> windings = motor_windings(robot, {});
  ASSERT_EQ(windings.size(), robot.actuators.size());
  const MotorWinding& knee = windings[5];
  EXPECT_EQ(knee.joint, 5);
  EXPECT_NEAR(knee.voltage_V(2.0 * 10.85, 2.0), 4.6 + 21.7, 1e-9);
  EXPECT_NEAR(knee.power_W(2.0 * 10.85, 2.0), 2.0 * (4.6 + 21.7), 1e-9);
  EXPECT_NEAR(knee.power_W(2.0 * 10.85, 0.0), 2.3 * 2.0 * 2.0, 1e-9) << "holding heats the copper";
  EXPECT_LT(knee.power_W(2.0 * 10.85, -2.0), 0.0) << "braking gives back";
}

TEST(MotorWindings, AnActuatorThatTurnsSeveralJointsTurnsNoneAlone) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  for (const MotorWinding& one : motor_windings(robot, {})) EXPECT_EQ(one.joint, -1);
}

}  // namespace
}  // namespace sprung
