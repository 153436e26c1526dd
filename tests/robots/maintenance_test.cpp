#include "robots/maintenance.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(MaintenanceTest, LowersEverySpeedAndTorqueAndAsksForAHold) {
  for (const char* name : {"single_leg", "pegasus", "fennec"}) {
    const RobotConfig robot = load_robot(name);
    const RobotConfig reduced = for_maintenance(robot);
    EXPECT_FALSE(robot.hold_to_run);
    EXPECT_TRUE(reduced.hold_to_run);
    for (std::size_t i = 0; i < robot.actuators.size(); ++i) {
      EXPECT_EQ(reduced.actuators[i].speed_limit_rad_s, 0.25 * robot.actuators[i].speed_limit_rad_s);
      EXPECT_EQ(reduced.actuators[i].torque_limit_Nm, 0.5 * robot.actuators[i].torque_limit_Nm);
    }
    for (std::size_t i = 0; i < robot.presets.size(); ++i)
      EXPECT_EQ(reduced.presets[i].rise_time_s, 4.0 * robot.presets[i].rise_time_s);
  }
}

TEST(MaintenanceTest, FallIsNotMetByLegsThatMoveFast) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_TRUE(robot.body.meets_falls);
  EXPECT_FALSE(for_maintenance(robot).body.meets_falls);
}

TEST(MaintenanceTest, WhatARobotIsBuiltForStaysAsItWas) {
  const RobotConfig robot = load_robot("pegasus");
  const RobotConfig reduced = for_maintenance(robot);
  EXPECT_EQ(reduced.lowering_s, 4.0 * robot.lowering_s);
  for (const RobotConfig& one : {robot, reduced}) {
    EXPECT_NEAR(as_built(one, 3).torque_limit_Nm, robot.actuators[3].torque_limit_Nm, 1e-12);
    EXPECT_NEAR(as_built(one, 3).speed_limit_rad_s, robot.actuators[3].speed_limit_rad_s, 1e-12);
  }
}

TEST(MaintenanceTest, FitsTheSameRobotFile) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_EQ(for_maintenance(robot).hash, robot.hash);
}

}  // namespace
}  // namespace sprung
