#include "drivers/bridge/setpoint_gate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

/// Joints within 1 rad either way; actuators up to 171.6 Nm, 12 rad/s, 308 Nm of rated current; cycles of
/// 1 ms.
class SetpointGateTest : public ::testing::Test {
 protected:
  explicit SetpointGateTest(RobotConfig robot = test::with_leg(test::two_drive_robot(), 1.0))
      : gate_(robot), robot_(std::move(robot)) {
    for (GateMotion& m : motion_) m = {0.0, 0.0, 0.0, true, false};
  }
  /// One cycle with this torque on both. @return what is left of the second one's.
  double torque(double torque_Nm) {
    for (ActuatorCommand& c : commands_) c = {torque_Nm, kNaN, 0.0, 0.0, DriveMode::kTorque};
    gate_.limit(motion_, commands_);
    return commands_[1].commanded_torque_Nm;
  }
  double position(double position_rad) {
    for (ActuatorCommand& c : commands_) c = {kNaN, 0.0, 0.0, 0.0, DriveMode::kPosition};
    commands_[1].commanded_position_rad = position_rad;
    gate_.limit(motion_, commands_);
    return commands_[1].commanded_position_rad;
  }
  std::int64_t count(GateLimit limit) const { return gate_.counts(1)[static_cast<std::size_t>(limit)]; }
  std::int64_t total() const {
    std::int64_t sum = 0;
    for (const std::int64_t one : gate_.counts(1)) sum += one;
    return sum;
  }

  SetpointGate gate_;
  RobotConfig robot_;
  std::vector<GateMotion> motion_{2};
  std::vector<ActuatorCommand> commands_{2};
};

TEST_F(SetpointGateTest, WhatIsWithinAllLimitsPassesUntouchedAndUncounted) {
  for (const double torque_Nm : {0.0, 40.0, 80.0, 50.0, 0.0, -40.0, -80.0})
    EXPECT_EQ(torque(torque_Nm), torque_Nm);
  EXPECT_EQ(position(0.05), 0.05);
  EXPECT_EQ(position(0.07), 0.07);
  EXPECT_EQ(total(), 0);
}

TEST_F(SetpointGateTest, JointBeyondItsLimitGetsNoTorqueFurtherOut) {
  motion_[1].measured_position_rad = 1.001;
  EXPECT_EQ(torque(30.0), 0.0);
  EXPECT_EQ(torque(-30.0), -30.0) << "the way back is free";
  motion_[1].measured_position_rad = -1.001;
  EXPECT_EQ(torque(-30.0), 0.0);
  EXPECT_EQ(torque(30.0), 30.0);
  EXPECT_EQ(count(GateLimit::kJointPosition), 2);
  EXPECT_EQ(gate_.counts(0)[static_cast<std::size_t>(GateLimit::kJointPosition)], 0);
}

TEST_F(SetpointGateTest, PositionsStayWithinTheJointsLimits) {
  motion_[1].measured_position_rad = 0.99;
  for (int i = 0; i < 10; ++i) EXPECT_LE(position(1.5), 1.0);
  EXPECT_EQ(position(1.5), 1.0);
  EXPECT_GE(count(GateLimit::kJointPosition), 10);
}

TEST_F(SetpointGateTest, TooFastGetsNoTorqueThatMakesItFaster) {
  motion_[1].filtered_velocity_rad_s = 12.5;
  EXPECT_EQ(torque(30.0), 30.0);
  motion_[1].filtered_velocity_rad_s = 12.7;
  EXPECT_EQ(torque(30.0), 0.0);
  EXPECT_EQ(torque(-30.0), -30.0) << "braking is free";
  EXPECT_EQ(count(GateLimit::kSpeed), 1);
}

TEST_F(SetpointGateTest, TorqueGrowsSlowlyAndEndsAtOnce) {
  const double step_Nm = 171.6 / 3.8;
  EXPECT_NEAR(torque(170.0), step_Nm, 1e-9);
  EXPECT_NEAR(torque(170.0), 2 * step_Nm, 1e-9);
  EXPECT_EQ(torque(0.0), 0.0);
  torque(40.0);
  EXPECT_NEAR(torque(-170.0), -step_Nm, 1e-9);
  EXPECT_EQ(count(GateLimit::kRate), 3);
}

TEST_F(SetpointGateTest, TorqueGoesOnFromWhatTheDriveGives) {
  motion_[1].measured_torque_Nm = 100.0;
  EXPECT_EQ(torque(140.0), 140.0);
  EXPECT_EQ(total(), 0);
}

TEST_F(SetpointGateTest, PositionBeginsNearTheJointAndGoesOnAtTwiceItsSpeedLimit) {
  const double first_rad = 2 * 12 * 0.001 + 0.25 * 171.6 / 503;
  EXPECT_NEAR(position(0.9), first_rad, 1e-9);
  EXPECT_NEAR(position(0.9), first_rad + 0.024, 1e-9);
  EXPECT_EQ(count(GateLimit::kRate), 2);
}

TEST_F(SetpointGateTest, AfterAnotherLevelItBeginsAnew) {
  torque(45.0);
  torque(90.0);
  gate_.forget();
  EXPECT_NEAR(torque(90.0), 171.6 / 3.8, 1e-9);
}

TEST_F(SetpointGateTest, WarmWindingGetsItsRatedCurrent) {
  motion_[1].measured_torque_Nm = 30.0;
  motion_[1].warm = true;
  torque(70.0);
  EXPECT_NEAR(torque(70.0), 30.8, 1e-9);
  EXPECT_EQ(count(GateLimit::kWinding), 2);
}

TEST_F(SetpointGateTest, DriveWithoutPowerAndDampingAreLeftAlone) {
  for (GateMotion& m : motion_) m.enabled = false;
  motion_[1].filtered_velocity_rad_s = 100.0;
  EXPECT_EQ(torque(170.0), 170.0);
  for (ActuatorCommand& c : commands_) c = {0.0, kNaN, 0.0, 50.0, DriveMode::kDamping};
  gate_.limit(motion_, commands_);
  EXPECT_EQ(commands_[1].commanded_damping_Nm_s_rad, 50.0);
  EXPECT_EQ(total(), 0);
}

TEST_F(SetpointGateTest, ShowsItsCountsInTheNodesHealth) {
  torque(170.0);
  motion_[1].filtered_velocity_rad_s = 13.0;
  torque(20.0);
  NodeHealth health;
  gate_.show(1, health);
  EXPECT_EQ(health.limited_rate, 1);
  EXPECT_EQ(health.limited_speed, 1);
  EXPECT_EQ(health.limited_joint_position + health.limited_power + health.limited_winding, 0);
}

class PowerGate : public SetpointGateTest {
 protected:
  static RobotConfig weak_robot() {
    RobotConfig robot = test::with_leg(test::two_drive_robot(), 1.0);
    for (ActuatorConfig& a : robot.actuators) a.power_limit_W = 100.0;
    return robot;
  }
  PowerGate() : SetpointGateTest(weak_robot()) {}
};

TEST_F(PowerGate, NoMorePowerThanTheActuatorMayGive) {
  motion_[1].filtered_velocity_rad_s = 5.0;
  EXPECT_NEAR(torque(40.0), 22.0, 1e-9);
  EXPECT_EQ(torque(-40.0), -40.0) << "braking is free";
  EXPECT_EQ(count(GateLimit::kPower), 1);
}

/// A knee that a parallelogram drives: its motor sees the sum of both joints.
class CoupledGate : public SetpointGateTest {
 protected:
  static RobotConfig parallelogram() {
    RobotConfig robot = test::with_leg(test::two_drive_robot(), 1.0);
    robot.legs[0].transmission = {1, 0, -1, 1};  // knee = second actuator - first
    return robot;
  }
  CoupledGate() : SetpointGateTest(parallelogram()) {}
};

TEST_F(CoupledGate, LimitsAreThoseOfTheJoints) {
  motion_[0].measured_position_rad = -0.6;
  motion_[1].measured_position_rad = 0.5;  // the knee is at 1.1 rad
  commands_[0] = {0.0, kNaN, 0.0, 0.0, DriveMode::kTorque};
  commands_[1] = {20.0, kNaN, 0.0, 0.0, DriveMode::kTorque};
  gate_.limit(motion_, commands_);
  EXPECT_NEAR(commands_[1].commanded_torque_Nm, 0.0, 1e-9);
  EXPECT_NEAR(commands_[0].commanded_torque_Nm, 20.0, 1e-9) << "the hip's share stays";
}

}  // namespace
}  // namespace sprung
