#include "simulation/plant/drive_truth.h"

#include <gtest/gtest.h>

#include "robots/config_error.h"

namespace sprung::sim {
namespace {

YamlMap yaml(const std::string& text) { return YamlMap::parse(text, "sim.yaml"); }

TEST(DriveTruth, WindingHasAResistanceAndByDefaultTheTorqueConstantsBackEmf) {
  const WindingConfig least = read_winding(yaml("resistance: 2.3 ohm"));
  EXPECT_EQ(least.resistance_ohm, 2.3);
  EXPECT_FALSE(least.back_emf_V_s_rad.has_value());
  EXPECT_EQ(least.voltage_share, 1.0);
  const WindingConfig all = read_winding(
      yaml("{resistance: 2.3 ohm, back_emf: 0.2 V s/rad, voltage_share: 0.9}"));
  EXPECT_EQ(all.back_emf_V_s_rad.value(), 0.2);
  EXPECT_EQ(all.voltage_share, 0.9);
  EXPECT_THROW(read_winding(yaml("resistance: 0 ohm")), ConfigError);
  EXPECT_THROW(read_winding(yaml("{resistance: 2 ohm, inductance: 1}")), ConfigError);
}

TEST(DriveTruth, SensorAndLoopAreTrueWhereNothingIsSaid) {
  const CurrentSensorConfig sensor = read_current_sensor(yaml("{offset: 0.03 A}"));
  EXPECT_EQ(sensor.offset_A, 0.03);
  EXPECT_EQ(sensor.gain, 1.0);
  const PositionLoopConfig loop = read_position_loop(
      yaml("{stiffness_share: 1.2, following_error: 0.3 rad}"));
  EXPECT_EQ(loop.stiffness_share, 1.2);
  EXPECT_EQ(loop.damping_share, 1.0);
  EXPECT_EQ(loop.following_error_rad, 0.3);
  EXPECT_THROW(read_current_sensor(yaml("gain: 0")), ConfigError);
  EXPECT_THROW(read_position_loop(yaml("damping_share: -1")), ConfigError);
}

TEST(DriveTruth, SupplyIsABatteryUnlessToldOtherwise) {
  const std::string least = "voltage: 48 V\nresistance: 0.15 ohm\ncapacity: 0.01 F\n";
  EXPECT_TRUE(read_supply(yaml(least)).takes_back);
  EXPECT_EQ(read_supply(yaml(least)).chopper_V, 0.0);
  const SupplyConfig bench = read_supply(
      yaml(least + "source: rectifier\nchopper: {voltage: 54 V, resistance: 2 ohm}"));
  EXPECT_FALSE(bench.takes_back);
  EXPECT_EQ(bench.chopper_V, 54.0);
  EXPECT_EQ(bench.chopper_ohm, 2.0);
  EXPECT_THROW(read_supply(yaml(least + "source: mains")), ConfigError);
  EXPECT_THROW(read_supply(yaml(least + "chopper: {voltage: 40 V, resistance: 2 ohm}")), ConfigError);
}

TEST(DriveTruth, ComputerIsInTimeUnlessToldOtherwise) {
  const TimingConfig least = read_timing(yaml("{compute_time: 0.3 ms, sync_jitter: 2 us}"));
  EXPECT_NEAR(least.sync_jitter_s, 2e-6, 1e-18);
  EXPECT_EQ(least.compute_tail_s, 0.0);
  EXPECT_EQ(least.missed_cycles, 0.0);
  const TimingConfig late = read_timing(
      yaml("{compute_time: 0.3 ms, sync_jitter: 0 us, compute_tail: 0.05 ms, missed_cycles: 0.001}"));
  EXPECT_NEAR(late.compute_tail_s, 5e-5, 1e-15);
  EXPECT_EQ(late.missed_cycles, 0.001);
}

}  // namespace
}  // namespace sprung::sim
