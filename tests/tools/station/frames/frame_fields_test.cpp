#include "tools/station/frames/frame_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "robots/robot_loader.h"
#include "tools/logs/fields/type_table.h"
#include "tools/station/frames/frame_layout.h"

namespace sprung::station {
namespace {

using testing::Contains;
using testing::Pair;

const FrameField& field(const std::vector<FrameField>& fields, const std::string& name) {
  const int index = find_field(fields, name);
  if (index < 0) throw std::out_of_range(name);
  return fields[static_cast<std::size_t>(index)];
}

TEST(FrameFields, AreNamedByTheRobotAndSayWhereTheyStand) {
  const auto fields = frame_fields(load_robot("pegasus"));
  const FrameField& torque = field(fields, "joints.fl_knee.gear_output_torque_Nm");
  EXPECT_EQ(torque.unit, "Nm");
  EXPECT_EQ(torque.channel, "JOINT_STATE");
  EXPECT_EQ(torque.path, "joints[2].gear_output_torque_Nm");
  EXPECT_EQ(field(fields, "legs.hr.foot_force_N.z").path, "legs[3].foot_force_N[2]");
  EXPECT_EQ(field(fields, "body.estimated_quaternion_wxyz.w").path, "body.estimated_quaternion_wxyz[0]");
  EXPECT_THAT(field(fields, "safety.level").words, Contains(Pair(0, "operational")));
}

TEST(FrameFields, NoNameIsThereTwice) {
  for (const char* robot : {"single_leg", "pegasus", "fennec", "test_axis"}) {
    std::set<std::string> names;
    for (const FrameField& one : frame_fields(load_robot(robot)))
      EXPECT_TRUE(names.insert(one.name).second) << robot << ": " << one.name;
  }
}

TEST(FrameFields, TemperaturesAndBatteryAreThereWhereRobotYamlHasThem) {
  RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(find_field(frame_fields(robot), "actuators.knee_motor.measured_temperature_degC"), -1);
  EXPECT_EQ(find_field(frame_fields(robot), "auxiliary.battery_voltage_V"), -1);
  robot.actuators[1].temperature.reading.index = 0x22A2;
  robot.battery.bus = 0;
  const auto fields = frame_fields(robot);
  const FrameField& temperature = field(fields, "actuators.knee_motor.measured_temperature_degC");
  EXPECT_EQ(temperature.channel, "AUXILIARY_STATE");
  EXPECT_EQ(temperature.path, "measured_temperature_degC[1]");
  EXPECT_EQ(temperature.unit, "degC");
  EXPECT_EQ(find_field(fields, "actuators.hip_motor.measured_temperature_degC"), -1);
  EXPECT_EQ(field(fields, "auxiliary.battery_charge_share").path, "battery_charge_share");
}

TEST(FrameFields, TheComputedOnesStandLast) {
  const RobotConfig robot = load_robot("single_leg");
  const auto fields = frame_fields(robot);
  EXPECT_EQ(fields.back().name, "joints.knee.desired_position_rad");
  EXPECT_EQ(find_field(fields, "trunk.x_m") + 8 + 2, static_cast<int>(fields.size()));
  EXPECT_EQ(find_field(fields, "nothing"), -1);
}

TEST(FrameFields, TheLayoutHasThemInTheirOrderWithTheirWords) {
  const RobotConfig robot = load_robot("single_leg");
  const auto fields = frame_fields(robot);
  const nlohmann::json layout = frame_layout(robot, fields);
  EXPECT_EQ(layout["robot"], "single_leg");
  EXPECT_EQ(layout["cycle_s"], 0.001);
  EXPECT_EQ(layout["joints"], nlohmann::json({"hip", "knee"}));
  ASSERT_EQ(layout["fields"].size(), fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) EXPECT_EQ(layout["fields"][i]["name"], fields[i].name);
  const auto level = static_cast<std::size_t>(find_field(fields, "safety.level"));
  EXPECT_EQ(layout["fields"][level]["words"]["0"], "operational");
}

}  // namespace
}  // namespace sprung::station
