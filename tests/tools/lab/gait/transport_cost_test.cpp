#include "tools/lab/gait/transport_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class TransportCostTest : public testing::Test {
 protected:
  void add(double torque_Nm, double speed_rad_s) {
    SimTruth truth(robot_.joints.size(), robot_.legs.size());
    for (TrueJoint& joint : truth.joints) joint.true_motor_torque_Nm = joint.true_velocity_rad_s = 0.0;
    truth.joints[5].true_motor_torque_Nm = torque_Nm;
    truth.joints[5].true_velocity_rad_s = speed_rad_s;
    cost_.add(truth);
  }

  const RobotConfig robot_ = load_robot("pegasus");
  TransportCost cost_{robot_, {}};
};

TEST_F(TransportCostTest, IsTheBaseLoadWhereNoMotorWorks) {
  EXPECT_TRUE(std::isnan(cost_.mean_W())) << "nothing was seen yet";
  add(0.0, 3.0);
  EXPECT_NEAR(cost_.mean_W(), 15.0 + 12 * 3.0, 1e-12);
}

TEST_F(TransportCostTest, IsPowerOverWeightAndSpeed) {
  add(10.85, 1.0);  // 1 A and 2.3 + 10.85 V
  EXPECT_NEAR(cost_.mean_W(), 51.0 + 13.15, 1e-9);
  EXPECT_NEAR(cost_.at(0.5), (51.0 + 13.15) / (30.0 * 9.81 * 0.5), 0.01);
}

TEST_F(TransportCostTest, WhatBrakingGivesBackBeyondTheOthersNeedIsBurnt) {
  add(10.85, -5.0);
  EXPECT_NEAR(cost_.mean_W(), 51.0, 1e-9);
}

TEST(TransportCost, IsNotKnownOfActuatorsThatTurnSeveralJoints) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  TransportCost cost(robot, {});
  cost.add(SimTruth(robot.joints.size(), robot.legs.size()));
  EXPECT_TRUE(std::isnan(cost.mean_W()));
}

}  // namespace
}  // namespace sprung
