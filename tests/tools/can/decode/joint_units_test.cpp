#include "tools/can/decode/joint_units.h"

#include <gtest/gtest.h>

#include "drivers/profiles/drive_profile.h"
#include "robots/robot_loader.h"

namespace sprung::cantools {
namespace {

ActuatorConfig actuator() {
  ActuatorConfig actuator = load_robot("single_leg").actuators[0];
  actuator.direction = -1.0;
  actuator.offset_rad = 0.25;
  return actuator;
}

double value_in(const std::vector<JointValue>& values, const std::string& unit) {
  for (const JointValue& value : values) {
    if (value.unit == unit) return value.value;
  }
  ADD_FAILURE() << "no " << unit;
  return 0.0;
}

/// The bridge's own reading of the same sample is the judge.
TEST(JointUnits, AgreeWithTheProfile) {
  const ActuatorConfig gold = actuator();
  const auto profile = make_profile(gold, {1e-3, 5e-3, 20e-3});
  CanFrame frame;
  frame.id = canopen::tpdo_id(0, gold.node);
  frame.length = 8;
  canopen::put_le(&frame.data[0], 1'234'567, 4);
  canopen::put_le(&frame.data[4], static_cast<std::uint32_t>(-345), 2);
  DriveSample sample;
  ASSERT_TRUE(profile->decode_sample(frame, sample));
  EXPECT_NEAR(value_in(in_joint_units(gold, {0x6064, 0}, "counts", 1'234'567), "rad"),
              sample.measured_position_rad, 1e-12);
  EXPECT_NEAR(value_in(in_joint_units(gold, {0x6077, 0}, "per mille of rated torque", -345), "A"),
              sample.measured_current_A, 1e-12);
}

TEST(JointUnits, TorqueIsAtTheGearsOutput) {
  const ActuatorConfig gold = actuator();
  const double rated_Nm = gold.torque_constant_Nm_A * gold.rated_current_A * gold.gear_ratio;
  EXPECT_NEAR(value_in(in_joint_units(gold, {0x6071, 0}, "per mille of rated torque", 1000), "Nm"), -rated_Nm,
              1e-9);
  EXPECT_NEAR(value_in(in_joint_units(gold, {0x2030, 0}, "mA", 1000), "A"), -1.0, 1e-12);
  EXPECT_NEAR(value_in(in_joint_units(gold, {0x2030, 0}, "mA", 1000), "Nm"),
              -gold.torque_constant_Nm_A * gold.gear_ratio, 1e-12);
}

TEST(JointUnits, OnlyAbsolutePositionsHaveTheOffset) {
  const ActuatorConfig gold = actuator();
  EXPECT_DOUBLE_EQ(value_in(in_joint_units(gold, {0x6064, 0}, "counts", 0), "rad"), 0.25);
  EXPECT_DOUBLE_EQ(value_in(in_joint_units(gold, {0x607A, 0}, "counts", 0), "rad"), 0.25);
  EXPECT_DOUBLE_EQ(value_in(in_joint_units(gold, {0x60F4, 0}, "counts", 0), "rad"), 0.0);
}

TEST(JointUnits, SpeedsOfEitherMake) {
  ActuatorConfig one = actuator();
  one.direction = 1.0;
  one.gear_ratio = 50.0;
  one.encoder_counts_per_turn = 2000.0;
  EXPECT_NEAR(value_in(in_joint_units(one, {0x606C, 0}, "rpm", 3000), "rad/s"), 2.0 * 3.14159265358979, 1e-9);
  EXPECT_NEAR(value_in(in_joint_units(one, {0x606C, 0}, "counts/s", 100'000), "rad/s"),
              2.0 * 3.14159265358979, 1e-9);
}

TEST(JointUnits, WhatHasNoCounterpartHasNone) {
  EXPECT_TRUE(in_joint_units(actuator(), {0x6079, 0}, "mV", 48000).empty());
  EXPECT_TRUE(in_joint_units(actuator(), {0x6041, 0}, "", 0x237).empty());
}

}  // namespace
}  // namespace sprung::cantools
