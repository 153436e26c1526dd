#include "tools/station/server/live_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

TEST(LiveReport, NamesStandInTheRobotAndNumbersInTheirOrder) {
  const RobotConfig robot = load_robot("pegasus");
  const auto names = robot_json(robot);
  EXPECT_EQ(names["joints"].size(), 12u);
  EXPECT_EQ(names["joints"][1]["name"], "fl_hip");
  EXPECT_EQ(names["joints"][1]["torque_limit_Nm"], 108.0);
  EXPECT_EQ(names["gaits"].size(), 3u) << "standing is no gait to drive in";
}

TEST(LiveReport, WhatNobodyMeasuredIsNullAndNumbersAreShort) {
  JointState joints(1, 1);
  joints.joints[0].gear_output_torque_Nm = 12.3456789;
  joints.joints[0].gear_output_torque_bound_Nm = 0.0;
  joints.legs[0].foot_force_N = {1e-9, -123456.7, kNaN};
  const auto live = live_json(joints, DriveState(1));
  EXPECT_EQ(live["joints"][0]["torque_Nm"].dump(), "12.346");
  EXPECT_EQ(live["joints"][0]["torque_bound_Nm"], 0.0);
  EXPECT_TRUE(live["joints"][0]["temperature_degC"].is_null());
  EXPECT_EQ(live["legs"][0]["force_N"][1], -123460.0);
  EXPECT_TRUE(live["legs"][0]["force_N"][2].is_null());
  EXPECT_TRUE(live["actuators"][0]["supply_V"].is_null());
  EXPECT_EQ(live["actuators"][0]["power"], "unknown");
}

}  // namespace
}  // namespace sprung::station
