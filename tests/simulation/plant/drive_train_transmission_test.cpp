#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "simulation/plant/drive_train.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

RobotConfig coupled(const std::vector<double>& transmission) {
  RobotConfig robot = load_robot(test::source_dir() + "/robots/single_leg");
  robot.legs[0].transmission = transmission;
  return robot;
}

TEST(Transmission, InvertsTheRobotsMatrix) {
  const Transmission belt(coupled({1, 0, 0.01, 1}));
  std::vector<double> actuators(2);
  belt.to_actuators({2.0, 0.5}, actuators);
  EXPECT_NEAR(actuators[0], 2.0, 1e-15);
  EXPECT_NEAR(actuators[1], 0.48, 1e-15);
}

TEST(Transmission, KeepsPower) {
  const Transmission belt(coupled({1, 0.2, 0.01, 1}));
  const std::vector<double> joint_rad_s = {1.5, -4.0};
  const std::vector<double> actuator_Nm = {20.0, 35.0};
  std::vector<double> actuator_rad_s(2);
  std::vector<double> joint_Nm(2);
  belt.to_actuators(joint_rad_s, actuator_rad_s);
  belt.torques_to_joints(actuator_Nm, joint_Nm);
  EXPECT_NEAR(actuator_Nm[0] * actuator_rad_s[0] + actuator_Nm[1] * actuator_rad_s[1],
              joint_Nm[0] * joint_rad_s[0] + joint_Nm[1] * joint_rad_s[1], 1e-12);
}

TEST(Transmission, LegsAreEachTheirOwn) {
  RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  robot.legs[1].transmission = {1, 0, 0, 0, 1, 0, 0, 1, 1};  // knee driven from the trunk
  const Transmission linkage(robot);
  const std::vector<double> ones(12, 1.0);
  std::vector<double> actuators(12), joints(12);
  linkage.to_actuators(ones, actuators);
  linkage.torques_to_joints(ones, joints);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_DOUBLE_EQ(actuators[i], i == 5 ? 0.0 : 1.0) << "knee less hip, of the second leg alone";
    EXPECT_DOUBLE_EQ(joints[i], i == 4 ? 0.0 : 1.0);
  }
}

TEST(Transmission, SingularMatrixIsRefused) {
  EXPECT_THROW(Transmission(coupled({1, 1, 1, 1})), ConfigError);
}

}  // namespace
}  // namespace sprung::sim
