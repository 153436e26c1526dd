#include "controller/position_window.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr double kCycle_s = 0.002;

ActuatorConfig actuator() {
  ActuatorConfig out;
  out.torque_limit_Nm = 100.0;
  out.position_stiffness_Nm_rad = 500.0;  // all torque at 0.2 rad
  return out;
}

TEST(PositionWindowTest, SetPointsWithinItAreAsTheyWere) {
  PositionWindow window(actuator());
  EXPECT_EQ(window.hold(1.39, 1.0, kCycle_s), 1.39);
  EXPECT_EQ(window.hold(0.61, 1.0, kCycle_s), 0.61);
  EXPECT_FALSE(window.acts());
}

TEST(PositionWindowTest, SetPointsBeyondItGoWithTheActuator) {
  PositionWindow window(actuator());
  EXPECT_DOUBLE_EQ(window.hold(2.0, 1.0, kCycle_s), 1.4);
  EXPECT_TRUE(window.acts());
  EXPECT_DOUBLE_EQ(window.hold(2.0, 0.5, kCycle_s), 0.9);
  EXPECT_DOUBLE_EQ(window.hold(-2.0, 0.5, kCycle_s), 0.1);
}

TEST(PositionWindowTest, WhatStaysBlockedIsLeftToTheDriveToReport) {
  PositionWindow window(actuator());
  double held_s = 0.0;
  while (window.hold(2.0, 1.0, kCycle_s) < 2.0) held_s += kCycle_s;
  EXPECT_NEAR(held_s, PositionWindow::kHold_limit_s, 2.0 * kCycle_s);
  EXPECT_FALSE(window.acts());
  EXPECT_EQ(window.hold(1.1, 1.0, kCycle_s), 1.1);
  EXPECT_DOUBLE_EQ(window.hold(2.0, 1.0, kCycle_s), 1.4) << "the time begins anew";
}

TEST(PositionWindowTest, AnActuatorWithUnknownStiffnessHasNone) {
  ActuatorConfig unknown = actuator();
  unknown.position_stiffness_Nm_rad = 0.0;
  EXPECT_EQ(PositionWindow(unknown).hold(50.0, 0.0, kCycle_s), 50.0);
}

}  // namespace
}  // namespace sprung
