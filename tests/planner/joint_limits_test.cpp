#include "planner/joint_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(JointLimitsTest, AreThoseOfTheRobotFileThroughTheIdentity) {
  const RobotConfig robot = load_robot("pegasus");
  const std::vector<JointLimits> limits = joint_limits(robot);
  ASSERT_EQ(limits.size(), 12u);
  EXPECT_NEAR(limits[1].position_min_rad, 0.4 + 0.02, 1e-12);
  EXPECT_NEAR(limits[1].position_max_rad, 3.0 - 0.02, 1e-12);
  EXPECT_NEAR(limits[1].speed_rad_s, 4.36, 1e-12);
  EXPECT_NEAR(limits[1].acceleration_rad_s2, 108.0 / robot.joints[1].armature_kg_m2, 1e-9);
}

TEST(JointLimitsTest, CoupledActuatorsShareTheJointsMotion) {
  RobotConfig robot = load_robot("single_leg");
  // knee joint = -2 hip motor + knee motor: a hip that moves alone turns the knee motor twice as fast.
  robot.legs[0].transmission = {1.0, 0.0, -2.0, 1.0};
  const std::vector<JointLimits> limits = joint_limits(robot);
  EXPECT_NEAR(limits[0].speed_rad_s, 12.0 / 2.0, 1e-9);
  EXPECT_NEAR(limits[1].speed_rad_s, 12.0, 1e-9);
  // A knee that is accelerated alone asks twice its torque of the hip motor.
  EXPECT_NEAR(limits[1].acceleration_rad_s2, 171.6 / (2.0 * robot.joints[1].armature_kg_m2), 1e-9);
}

TEST(JointLimitsTest, UnknownArmatureLimitsNoAcceleration) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints[0].armature_kg_m2 = 0.0;
  EXPECT_TRUE(std::isinf(joint_limits(robot)[0].acceleration_rad_s2));
}

TEST(JointLimitsTest, JointOfNoLegCannotMove) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints.push_back(robot.joints[0]);
  EXPECT_EQ(joint_limits(robot)[2].speed_rad_s, 0.0);
}

TEST(JointLimitsTest, SingularTransmissionIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1.0, 1.0, 1.0, 1.0};
  EXPECT_THROW(joint_limits(robot), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
