#include "drivers/bridge/host_position_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

constexpr double kCycle_s = 0.001;

/// 503 Nm/rad, 29.7 Nm s/rad, at most 171.6 Nm and 12 rad/s.
ActuatorConfig actuator() { return test::two_drive_robot().actuators[0]; }

TEST(HostPositionLoop, IsASpringToTheSetPointAndADamper) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_NEAR(loop.torque_Nm(0.1, 0.0, 0.0), 50.3, 1e-9);
  loop.forget();
  EXPECT_NEAR(loop.torque_Nm(0.1, 0.1, 2.0), -59.4 - 503 * 0.003, 1e-9);
}

TEST(HostPositionLoop, ReferenceMovesInAStraightLineBetweenSetPoints) {
  HostPositionLoop loop(actuator(), kCycle_s);
  loop.torque_Nm(0.1, 0.1, 2.0);
  EXPECT_NEAR(loop.torque_Nm(0.102, 0.1, 2.0), 503 * (0.001 - 0.003), 1e-9);  // as fast as its reference
  loop.torque_Nm(0.102, 0.1, 0.0);
  EXPECT_NEAR(loop.torque_Nm(0.102, 0.102, 0.0), 0.0, 1e-9);
}

TEST(HostPositionLoop, ActsOnWhereTheJointWillBeAndHowFastWhenItsTorqueActs) {
  HostPositionLoop loop(actuator(), kCycle_s);
  loop.torque_Nm(0.0, 0.0, 1.0);
  // At 1 rad/s and 0.2 rad/s more each cycle, after a sample at 0.001 rad.
  EXPECT_NEAR(loop.torque_Nm(0.0, 0.001, 1.2), -503 * (0.001 + 0.0015 * 1.2) - 29.7 * 1.4, 1e-9);
}

TEST(HostPositionLoop, FirstVelocityHasNoAcceleration) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_NEAR(loop.torque_Nm(0.0, -0.0015 * 2.0, 2.0), -59.4, 1e-9);
  loop.forget();
  EXPECT_NEAR(loop.torque_Nm(0.0, 0.0015 * 2.0, -2.0), 59.4, 1e-9);
}

TEST(HostPositionLoop, FirstSetPointHasNoSpeed) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_FALSE(loop.closed());
  EXPECT_NEAR(loop.torque_Nm(5.0, 5.0, 0.0), 0.0, 1e-9);
  EXPECT_TRUE(loop.closed());
  loop.forget();
  EXPECT_FALSE(loop.closed());
  EXPECT_NEAR(loop.torque_Nm(-5.0, -5.0, 0.0), 0.0, 1e-9);
}

TEST(HostPositionLoop, StaysWithinTheTorqueLimit) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_EQ(loop.torque_Nm(3.0, 0.0, 0.0), 171.6);
  EXPECT_EQ(loop.torque_Nm(-3.0, 0.0, 0.0), -171.6);
}

TEST(HostPositionLoop, MakesNothingFasterThanTheSpeedLimitButBrakes) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_EQ(loop.torque_Nm(3.0, 0.0, 12.5), 171.6);  // within the slack of 5 %
  EXPECT_EQ(loop.torque_Nm(3.0, 0.0, 12.7), 0.0);
  EXPECT_EQ(loop.torque_Nm(-3.0, 0.0, 12.7), -171.6);
}

TEST(HostPositionLoop, WithoutAMeasurementThereIsNoTorque) {
  HostPositionLoop loop(actuator(), kCycle_s);
  EXPECT_EQ(loop.torque_Nm(1.0, kNaN, 0.0), 0.0);
  EXPECT_EQ(loop.torque_Nm(kNaN, 0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace sprung
