#include "simulation/plant/sim_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

class SimConfigTest : public testing::Test {
 protected:
  /// The shipped sim.yaml with one text replaced, read from a folder of its own.
  SimConfig load_with(const std::string& from, const std::string& to) {
    std::ifstream shipped(robot_.folder + "/sim.yaml");
    std::stringstream text;
    text << shipped.rdbuf();
    std::string changed = text.str();
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    RobotConfig robot = robot_;
    robot.folder = test::temp_dir() + "sim_config_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(robot.folder);
    std::ofstream(robot.folder + "/sim.yaml") << changed;
    return load_sim_config(robot, {});
  }
  std::string refusal(const std::string& from, const std::string& to) {
    return test::refusal_of<ConfigError>([&] { load_with(from, to); });
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/single_leg");
};

TEST_F(SimConfigTest, ShippedFileIsPlantJ3) {
  const SimConfig config = load_sim_config(robot_, {});
  EXPECT_EQ(config.plant.step_s, 0.25e-3);
  EXPECT_TRUE(config.plant.rail_x_locked);
  ASSERT_EQ(config.plant.joints.size(), 2U);
  EXPECT_EQ(config.plant.joints[1].name, "knee");
  EXPECT_EQ(config.plant.joints[1].armature_kg_m2, 0.81);
  EXPECT_EQ(config.plant.joints[1].friction.coulomb_Nm, 7.3);
  EXPECT_EQ(config.plant.contact.stiffness_N_m, 8200);
  ASSERT_EQ(config.drives.size(), 2U);
  EXPECT_EQ(config.drives[0].torque_loop_Hz, 94);
  EXPECT_NEAR(config.timing.compute_s, 0.3e-3, 1e-15);
}

TEST_F(SimConfigTest, UnknownKeyIsRefusedWithFileAndLineWhereverItStands) {
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"\nplant:", "\nceiling: 3\nplant:"},
      {"  floor_height:", "  ceiling: 3 m\n  floor_height:"},
      {"      initial: 2.3595 rad", "      initial: 2.3595 rad\n      ceiling: 3"},
      {"{name: base,", "{name: base, ceiling: 3,"},
      {"{min: 0.02 rad,", "{ceiling: 3, min: 0.02 rad,"},
      {"{coulomb:", "{ceiling: 3, coulomb:"},
      {"contact: {", "contact: {ceiling: 3, "},
      {"    supply:", "    ceiling: 3\n    supply:"},
      {"  sync_jitter: 0", "  ceiling: 3\n  sync_jitter: 0"}};
  for (const auto& [from, to] : changes) {
    const std::string error = refusal(from, to);
    EXPECT_NE(error.find("sim.yaml:"), std::string::npos) << to << ": " << error;
    EXPECT_NE(error.find("ceiling"), std::string::npos) << to << ": " << error;
  }
}

TEST_F(SimConfigTest, GroundHasSlopesErrorAndSteps) {
  const GroundConfig
      ground = load_with("  floor_height:",
                         "  ground: {slope: 0.1 rad, begins: 1 m, wave: 0.03 m, wave_length: 0.8 m, error: "
                         "0.02 m, steps: [{from: 1 m, height: 0.02 m}, {from: 2 m, "
                         "length: 0.3 m, right: -0.2 m, width: 0.4 m, height: -0.02 m}]}\n  floor_height:")
                   .plant.ground;
  EXPECT_EQ(ground.slope_rad, 0.1);
  EXPECT_EQ(ground.side_slope_rad, 0.0);
  EXPECT_EQ(ground.begins_m, 1.0);
  EXPECT_EQ(ground.wave_m, 0.03);
  EXPECT_EQ(ground.wave_length_m, 0.8);
  EXPECT_EQ(ground.error_m, 0.02);
  ASSERT_EQ(ground.steps.size(), 2U);
  EXPECT_EQ(ground.steps[0].area.length_m, 0.0);
  EXPECT_EQ(ground.steps[1].area.right_m, -0.2);
  EXPECT_NE(refusal("  floor_height:", "  ground: {ceiling: 3 m}\n  floor_height:").find("ceiling"),
            std::string::npos);
}

TEST_F(SimConfigTest, ImuNeedsEveryErrorWithItsUnit) {
  const std::string imu =
      "imu:\n  angular_velocity: {noise: 0.003 rad/s, bias: 0.002 rad/s}\n  specific_force: {noise: 0.03 "
      "m/s^2, "
      "bias: 0.04 m/s^2}\n  attitude: {noise: 0.0005 rad, tilt_bias: 0.004 rad, yaw_drift: 0.0002 rad/s}\n";
  const ImuConfig read = load_with("\ntiming:", "\n" + imu + "timing:").imu.value();
  EXPECT_EQ(read.rate_noise_rad_s, 0.003);
  EXPECT_EQ(read.rate_bias_rad_s, 0.002);
  EXPECT_EQ(read.force_noise_m_s2, 0.03);
  EXPECT_EQ(read.force_bias_m_s2, 0.04);
  EXPECT_EQ(read.attitude_noise_rad, 0.0005);
  EXPECT_EQ(read.tilt_bias_rad, 0.004);
  EXPECT_EQ(read.yaw_drift_rad_s, 0.0002);
  std::string in_degrees = imu;
  in_degrees.replace(imu.find("0.003 rad/s"), 11, "0.2 deg/s");
  EXPECT_NE(refusal("\ntiming:", "\n" + in_degrees + "timing:").find("rad/s"), std::string::npos);
}

TEST_F(SimConfigTest, WrongUnitIsRefused) {
  EXPECT_NE(refusal("mass: 4.13 kg", "mass: 4.13 g").find("kg"), std::string::npos);
}

TEST_F(SimConfigTest, BreakawayBelowCoulombIsRefused) {
  EXPECT_NE(refusal("breakaway: 7.3 Nm", "breakaway: 7.2 Nm").find("breakaway"), std::string::npos);
}

TEST_F(SimConfigTest, RailIsLockedOrFree) {
  EXPECT_FALSE(load_with("rail_x: locked", "rail_x: free").plant.rail_x_locked);
  EXPECT_NE(refusal("rail_x: locked", "rail_x: loose").find("locked or free"), std::string::npos);
}

TEST_F(SimConfigTest, EveryJointAndDriveIsListedOnce) {
  EXPECT_NE(refusal("- name: knee", "- name: hip").find("exactly once"), std::string::npos);
  EXPECT_NE(refusal("- actuator: knee_motor", "- actuator: ankle_motor").find("knee_motor"),
            std::string::npos);
}

TEST_F(SimConfigTest, AnotherRobotsFileIsRefused) {
  EXPECT_NE(refusal("robot: single_leg", "robot: pegasus").find("pegasus"), std::string::npos);
}

TEST_F(SimConfigTest, OptionalKeysOfADriveHaveTheirDefaults) {
  const SimDriveConfig drive = load_sim_config(robot_, {}).drives[0];
  EXPECT_TRUE(drive.absolute_encoder);
  EXPECT_FALSE(drive.starts_in_fault);
  EXPECT_FALSE(drive.latches_communication_faults.has_value());
  EXPECT_EQ(drive.mode_delay_s, 0.0);
  EXPECT_EQ(drive.kinematic_error.amplitude_rad, 0.0);
}

TEST_F(SimConfigTest, OptionalKeysOfADriveAreRead) {
  const SimDriveConfig
      drive = load_with(
                  "    supply: 48 V",
                  "    encoder: incremental\n    index_angle: 1.5 rad\n    mode_delay: 2 ms\n    "
                  "position_smoothing: 3 ms\n    "
                  "starts_in_fault: true\n"
                  "    communication_faults: latched\n    supply_min: 20 V\n    supply_max: 60 V\n"
                  "    kinematic_error: {amplitude: 0.0003 rad, order: 2, phase: 1 rad}\n    supply: 48 V")
                  .drives[0];
  EXPECT_FALSE(drive.absolute_encoder);
  EXPECT_EQ(drive.index_angle_rad, 1.5);
  EXPECT_NEAR(drive.mode_delay_s, 0.002, 1e-12);
  EXPECT_NEAR(drive.smoothing_s, 0.003, 1e-12);
  EXPECT_TRUE(drive.starts_in_fault);
  EXPECT_TRUE(drive.latches_communication_faults.value_or(false));
  EXPECT_EQ(drive.supply_min_V, 20.0);
  EXPECT_EQ(drive.supply_max_V, 60.0);
  EXPECT_EQ(drive.kinematic_error.amplitude_rad, 0.0003);
  EXPECT_EQ(drive.kinematic_error.phase_rad, 1.0);
}

TEST_F(SimConfigTest, OptionalKeysAreAsStrictAsTheOthers) {
  const auto refused = [&](const std::string& key) {
    return refusal("    supply: 48 V", "    " + key + "\n    supply: 48 V");
  };
  EXPECT_NE(refused("encoder: resolver").find("absolute or incremental"), std::string::npos);
  EXPECT_NE(refused("communication_faults: maybe").find("latched or passing"), std::string::npos);
  EXPECT_NE(refused("supply_min: 50 V").find("supply_min"), std::string::npos);
  EXPECT_NE(refused("kinematic_error: {order: 2}").find("amplitude"), std::string::npos);
}

/// Cards of robot.yaml, with noise where sim.yaml gives some.
TEST_F(SimConfigTest, EncoderCardsAreAllListedOrNone) {
  robot_.encoder_cards.resize(2);
  robot_.encoder_cards[0].name = "first";
  robot_.encoder_cards[1].name = "second";
  ASSERT_EQ(load_sim_config(robot_, {}).cards.size(), 2U);
  EXPECT_EQ(load_sim_config(robot_, {}).cards[1].noise_rad, 0.0);
  const std::string both = "encoder_cards:\n  - {card: second, noise: 0.001 rad}\n  - {card: first}\ntiming:";
  EXPECT_EQ(load_with("timing:", both).cards[1].noise_rad, 0.001);
  EXPECT_NE(refusal("timing:", "encoder_cards:\n  - {card: first}\ntiming:").find("second"),
            std::string::npos);
}

TEST_F(SimConfigTest, TorqueSensorIsOptionalAndSitsAtAJointThatThereIs) {
  EXPECT_FALSE(load_sim_config(robot_, {}).torque_sensor.has_value());
  const auto with = [](const std::string& joint) {
    return "torque_sensor: {joint: " + joint + ", rate: 300 Hz, noise: 0.1 Nm, resolution: 0.02 Nm}\ntiming:";
  };
  const TorqueSensorConfig sensor = load_with("timing:", with("knee")).torque_sensor.value();
  EXPECT_EQ(sensor.joint, 1);
  EXPECT_EQ(sensor.rate_Hz, 300.0);
  EXPECT_EQ(sensor.noise_Nm, 0.1);
  EXPECT_EQ(sensor.resolution_Nm, 0.02);
  EXPECT_NE(refusal("timing:", with("elbow")).find("elbow"), std::string::npos);
}

TEST_F(SimConfigTest, GearsAreElasticOrRigidAndTheAirHasATemperature) {
  EXPECT_TRUE(load_with("  gears: rigid", "  gears: elastic").plant.torsion);
  const PlantConfig plant = load_with("  floor_height:", "  ambient: 30 degC\n  floor_height:").plant;
  EXPECT_FALSE(plant.torsion);
  EXPECT_EQ(plant.ambient_degC, 30.0);
  EXPECT_NE(refusal("  gears: rigid", "  gears: soft").find("elastic or rigid"), std::string::npos);
}

TEST_F(SimConfigTest, PlantChangesAct) {
  const SimConfig config = load_sim_config(robot_, {{"friction_scale", 1.2},
                                                    {"mass_scale", 0.9},
                                                    {"kt_scale", 1.05},
                                                    {"ground_stiffness", 20000},
                                                    {"armature_scale", 2.0},
                                                    {"floor_height", 0.1},
                                                    {"noise_scale", 0.0},
                                                    {"sync_jitter_us", 5.0},
                                                    {"rail_x_locked", 0.0},
                                                    {"torque_loop_Hz", 155.0},
                                                    {"peak_torque", 160.0},
                                                    {"ground_damping", 50.0},
                                                    {"ground_friction", 0.4},
                                                    {"compute_time_us", 500.0},
                                                    {"mode_delay_us", 2000.0},
                                                    {"winding", 1.0},
                                                    {"supply_voltage", 44.0},
                                                    {"supply_resistance", 0.2},
                                                    {"current_offset", 0.03},
                                                    {"current_gain", 1.02},
                                                    {"position_stiffness_share", 1.2},
                                                    {"position_damping_share", 0.8},
                                                    {"position_smoothing_us", 4000.0},
                                                    {"compute_tail_us", 50.0},
                                                    {"missed_cycles", 0.001},
                                                    {"starts_in_fault", 1.0}});
  EXPECT_NEAR(config.plant.joints[0].friction.coulomb_Nm, 8.76, 1e-12);
  EXPECT_NEAR(config.plant.bodies[0].mass_kg, 3.717, 1e-12);
  EXPECT_NEAR(config.drives[1].torque_constant_Nm_A, 0.0462, 1e-12);
  EXPECT_EQ(config.plant.contact.stiffness_N_m, 20000);
  EXPECT_EQ(config.plant.contact.damping_N_s_m, 50);
  EXPECT_EQ(config.plant.contact.friction, 0.4);
  EXPECT_NEAR(config.plant.joints[1].armature_kg_m2, 1.62, 1e-12);
  EXPECT_EQ(config.plant.floor_height_m, 0.1);
  EXPECT_EQ(config.drives[0].torque_noise_Nm, 0.0);
  EXPECT_EQ(config.drives[0].torque_loop_Hz, 155.0);
  EXPECT_EQ(config.drives[0].peak_torque_Nm, 160.0);
  EXPECT_NEAR(config.timing.sync_jitter_s, 5e-6, 1e-18);
  EXPECT_NEAR(config.timing.compute_s, 5e-4, 1e-18);
  EXPECT_FALSE(config.plant.rail_x_locked);
  EXPECT_NEAR(config.drives[1].mode_delay_s, 2e-3, 1e-15);
  EXPECT_TRUE(config.drives[1].starts_in_fault);
  EXPECT_TRUE(config.real_windings);
  EXPECT_EQ(config.supply->voltage_V, 44.0);
  EXPECT_EQ(config.supply->resistance_ohm, 0.2);
  EXPECT_EQ(config.drives[1].current_sensor.offset_A, 0.03);
  EXPECT_EQ(config.drives[1].current_sensor.gain, 1.02);
  EXPECT_EQ(config.drives[1].position_loop.stiffness_share, 1.2);
  EXPECT_EQ(config.drives[1].position_loop.damping_share, 0.8);
  EXPECT_NEAR(config.drives[1].smoothing_s, 4e-3, 1e-15);
  EXPECT_NEAR(config.timing.compute_tail_s, 5e-5, 1e-15);
  EXPECT_EQ(config.timing.missed_cycles, 0.001);
}

TEST_F(SimConfigTest, WindingsAreIdealOrRealAndWithoutThemNothingCanBeSwitchedOn) {
  EXPECT_FALSE(load_sim_config(robot_, {}).real_windings);
  EXPECT_TRUE(load_with("\nwindings: ideal", "\nwindings: real").real_windings);
  EXPECT_NE(refusal("\nwindings: ideal", "\nwindings: warm").find("real or ideal"), std::string::npos);
  SimConfig bare = load_sim_config(robot_, {});
  for (SimDriveConfig& drive : bare.drives) drive.winding.reset();
  bare.supply.reset();
  EXPECT_THROW(apply_plant_changes({{"winding", 1.0}}, bare), ConfigError);
  EXPECT_THROW(apply_plant_changes({{"supply_voltage", 44.0}}, bare), ConfigError);
  EXPECT_NO_THROW(apply_plant_changes({{"winding", 0.0}}, bare));
}

TEST_F(SimConfigTest, PlantChangesOutOfRangeAreRefused) {
  for (const double value : {-1.0, 1000.0, std::nan("")}) {
    EXPECT_THROW(load_sim_config(robot_, {{"friction_scale", value}}), ConfigError) << value;
  }
}

}  // namespace
}  // namespace sprung::sim
