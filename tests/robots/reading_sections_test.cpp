#include "robots/reading_sections.h"

#include <gtest/gtest.h>

#include <string>

#include "robots/config_error.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using robot_sections::read_battery;
using robot_sections::read_temperature;

TemperatureConfig temperature(const std::string& text) {
  return read_temperature(YamlMap::parse(text, "robot.yaml"));
}
BatteryConfig battery(const std::string& text) {
  return read_battery(YamlMap::parse(text, "robot.yaml"),
                      {{"leg", "udp:239.0.0.1:1"}, {"power", "memory:p"}});
}

TEST(ReadingSections, TemperatureHasObjectTypeScaleAndLimit) {
  const TemperatureConfig read = temperature(
      "{object: 0x22A2, sub: 1, type: i16, scale: 0.1 degC, max: 85 degC}");
  EXPECT_EQ(read.reading.index, 0x22A2);
  EXPECT_EQ(read.reading.sub, 1);
  EXPECT_EQ(read.max_degC, 85.0);
  EXPECT_DOUBLE_EQ(read.reading.value(0xFFFFFF9CU), -10.0) << "what lies beyond its two bytes is another's";
  EXPECT_DOUBLE_EQ(read.reading.value(0x000001F4U), 50.0);
}

TEST(ReadingSections, BatteryHasTheObjectsOfItsProfileUnlessItNamesOthers) {
  const BatteryConfig standard = battery("{bus: power, node: 20}");
  EXPECT_EQ(standard.bus, 1);
  EXPECT_EQ(standard.node, 20);
  EXPECT_EQ(standard.min_charge_share, 0.0);
  EXPECT_DOUBLE_EQ(standard.voltage.value(24 * 1024), 24.0);
  EXPECT_DOUBLE_EQ(standard.charge.value(63), 0.63);
  EXPECT_DOUBLE_EQ(standard.temperature.value(0xFFF8), -1.0);
  const BatteryConfig own = battery(
      "{bus: leg, node: 5, min_charge: 0.2, charge: {object: 0x2F00, sub: 3, type: u16, scale: 0.001}}");
  EXPECT_DOUBLE_EQ(own.charge.value(635), 0.635);
  EXPECT_EQ(own.charge.sub, 3);
  EXPECT_EQ(own.min_charge_share, 0.2);
  EXPECT_EQ(own.voltage.index, standard.voltage.index);
}

TEST(ReadingSections, WhatCannotBeIsRefusedWithItsKey) {
  for (const char* text : {"{object: 0x22A2, type: f32, scale: 0.1 degC, max: 85 degC}",
                           "{object: 0x22A2, type: i16, scale: 0.1 V, max: 85 degC}",
                           "{object: 0x22A2, type: i16, scale: 0.1 degC}",
                           "{object: 0x0FFF, type: i16, scale: 0.1 degC, max: 85 degC}",
                           "{object: 0x22A2, type: i16, scale: 0.1 degC, max: 85 degC, maximum: 3}"})
    EXPECT_THROW(temperature(text), ConfigError) << text;
  for (const char* text : {"{bus: other, node: 20}", "{bus: power, node: 127}", "{bus: power}",
                           "{bus: power, node: 20, min_charge: 15}"})
    EXPECT_THROW(battery(text), ConfigError) << text;
}

}  // namespace
}  // namespace sprung
