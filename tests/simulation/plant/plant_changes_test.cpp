/// `--plant` keys do what they say, for every robot.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/drive_train.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

class PlantChanges : public testing::TestWithParam<const char*> {
 protected:
  SimConfig config(const std::map<std::string, double>& changes) const {
    return load_sim_config(robot_, changes);
  }
  /// First acceleration of a joint under a torque, as the plant's truth has it.
  double acceleration(const std::map<std::string, double>& changes, std::size_t joint,
                      double torque_Nm) const {
    std::map<std::string, double> still = changes;
    still["friction_scale"] = 0.0;
    Plant plant(robot_, load_sim_config(robot_, still).plant);
    std::vector<double> torques(robot_.joints.size(), 0.0);
    plant.suspend(2.0);
    plant.step(torques);
    SimTruth truth(robot_.joints.size(), robot_.legs.size());
    plant.fill_truth(truth);
    const double without = truth.joints[joint].true_acceleration_rad_s2;
    plant.reset();
    plant.suspend(2.0);
    torques[joint] = torque_Nm;
    plant.step(torques);
    plant.fill_truth(truth);
    return truth.joints[joint].true_acceleration_rad_s2 - without;
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/" + GetParam());
};

TEST_P(PlantChanges, FrictionScaleIsOnEveryPartAndTheOthersOnTheirs) {
  const SimConfig plain = config({});
  const SimConfig all = config({{"friction_scale", 1.25}});
  const SimConfig parts = config(
      {{"coulomb_scale", 1.25}, {"viscous_scale", 1.25}, {"load_share_scale", 1.25}});
  const SimConfig coulomb = config({{"coulomb_scale", 0.5}});
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const FrictionConfig& f = plain.plant.joints[j].friction;
    for (const SimConfig* scaled : {&all, &parts}) {
      const FrictionConfig& g = scaled->plant.joints[j].friction;
      EXPECT_EQ(g.coulomb_Nm, 1.25 * f.coulomb_Nm);
      EXPECT_EQ(g.breakaway_Nm, 1.25 * f.breakaway_Nm);
      EXPECT_EQ(g.viscous_Nm_s_rad, 1.25 * f.viscous_Nm_s_rad);
      EXPECT_EQ(g.driving_share, 1.25 * f.driving_share);
      EXPECT_EQ(g.back_driving_share, 1.25 * f.back_driving_share);
      EXPECT_EQ(g.stribeck_speed_rad_s, f.stribeck_speed_rad_s);
      EXPECT_EQ(g.asymmetry, f.asymmetry);
    }
    EXPECT_EQ(coulomb.plant.joints[j].friction.coulomb_Nm, 0.5 * f.coulomb_Nm);
    EXPECT_EQ(coulomb.plant.joints[j].friction.viscous_Nm_s_rad, f.viscous_Nm_s_rad);
  }
}

/// The last joint of the first leg: rotor and link; a tenth more of both is a tenth less acceleration.
TEST_P(PlantChanges, MassAndArmatureScaleTheInertiaThatAJointFeels) {
  const std::size_t joint = static_cast<std::size_t>(robot_.legs[0].joints.back());
  const double plain = acceleration({}, joint, 10.0);
  EXPECT_NEAR(acceleration({{"mass_scale", 1.1}, {"armature_scale", 1.1}}, joint, 10.0), plain / 1.1,
              1e-3 * plain);
  EXPECT_LT(acceleration({{"armature_scale", 1.1}}, joint, 10.0), 0.999 * plain);
  EXPECT_LT(acceleration({{"mass_scale", 1.5}}, joint, 10.0), plain);
}

TEST_P(PlantChanges, TorqueConstantScaleIsOnWhatTheMotorTrulyGives) {
  const SimConfig plain = config({}), strong = config({{"kt_scale", 1.05}});
  for (std::size_t i = 0; i < plain.drives.size(); ++i) {
    EXPECT_EQ(strong.drives[i].torque_constant_Nm_A, 1.05 * plain.drives[i].torque_constant_Nm_A);
    // Robot.yaml's may be identified, so it has errors of its own.
    EXPECT_NEAR(plain.drives[i].torque_constant_Nm_A / robot_.actuators[i].torque_constant_Nm_A, 1.0, 0.02);
  }
}

TEST_P(PlantChanges, SuspendedHangsTheBaseAndTheFloorStays) {
  const PlantConfig hung = config({{"suspended", 0.75}}).plant;
  EXPECT_EQ(hung.suspended_m, 0.75);
  EXPECT_EQ(config({{"suspended", 0.0}}).plant.suspended_m, 0.0);
  Plant plant(robot_, hung);
  for (int i = 0; i < 400; ++i) plant.step(std::vector<double>(robot_.joints.size(), 0.0));
  SimTruth truth(robot_.joints.size(), robot_.legs.size());
  plant.fill_truth(truth);
  const bool bolted = std::string(GetParam()) == "test_axis";
  EXPECT_NEAR(truth.base_in_world_m[2], bolted ? 1.0 : 0.75, 1e-4);
}

/// Hung leg over a floor that comes up to it and goes away again.
TEST_P(PlantChanges, FloorThatRisesUnderAHangingFootPushesIt) {
  Plant plant(robot_, config({{"suspended", 0.75}}).plant);
  std::vector<double> nothing(robot_.joints.size(), 0.0);
  SimTruth truth(robot_.joints.size(), robot_.legs.size());
  for (int i = 0; i < 2000; ++i) plant.step(nothing);
  plant.fill_truth(truth);
  const double foot_m = truth.legs[0].true_foot_in_world_m[2];
  plant.set_floor_height(foot_m + 0.004);
  plant.step(nothing);
  plant.step(nothing);
  plant.fill_truth(truth);
  EXPECT_GT(truth.legs[0].true_contact_force_N[2], 10.0);
  plant.set_floor_height(foot_m - 0.5);
  plant.step(nothing);
  plant.fill_truth(truth);
  EXPECT_EQ(truth.legs[0].true_contact_force_N[2], 0.0);
}

TEST_P(PlantChanges, TemperatureAndHeatingReachThePlant) {
  const PlantConfig warm = config({{"temperature", 50.0}, {"heating_scale", 0.0}}).plant;
  EXPECT_EQ(warm.ambient_degC, 50.0);
  for (const PlantJointConfig& joint : warm.joints) EXPECT_EQ(joint.thermal.resistance_K_W, 0.0);
}

TEST_P(PlantChanges, GroundKeysReachTheGround) {
  const GroundConfig ground = config({{"slope", 0.1},
                                      {"side_slope", -0.2},
                                      {"ground_begins", 1.0},
                                      {"wave", 0.03},
                                      {"wave_length", 0.8},
                                      {"ground_error", 0.02},
                                      {"ground_seed", 5}})
                                  .plant.ground;
  EXPECT_EQ(ground.slope_rad, 0.1);
  EXPECT_EQ(config({{"roll", -1.57}}).plant.roll_rad, -1.57);
  EXPECT_EQ(ground.side_slope_rad, -0.2);
  EXPECT_EQ(ground.begins_m, 1.0);
  EXPECT_EQ(ground.wave_m, 0.03);
  EXPECT_EQ(ground.wave_length_m, 0.8);
  EXPECT_EQ(ground.error_m, 0.02);
  EXPECT_EQ(ground.error_seed, 5U);
  EXPECT_TRUE(ground.steps.empty());
  const GroundConfig stepped = config({{"step_from", 1.0},
                                       {"step_height", -0.02},
                                       {"step_length", 0.3},
                                       {"step_right", -0.1},
                                       {"step_width", 0.4}})
                                   .plant.ground;
  ASSERT_EQ(stepped.steps.size(), 1U);
  EXPECT_EQ(stepped.steps[0].area.from_m, 1.0);
  EXPECT_EQ(stepped.steps[0].height_m, -0.02);
  EXPECT_EQ(stepped.steps[0].area.length_m, 0.3);
  EXPECT_EQ(stepped.steps[0].area.right_m, -0.1);
  EXPECT_EQ(stepped.steps[0].area.width_m, 0.4);
  EXPECT_EQ(config({{"step_us", 500}}).plant.step_s, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(Robots, PlantChanges, testing::Values("single_leg", "pegasus", "test_axis"));

TEST(PlantChange, NoiseScaleReachesTheTorqueSensor) {
  const RobotConfig bench = load_robot(test::source_dir() + "/robots/test_axis");
  EXPECT_EQ(load_sim_config(bench, {}).torque_sensor.value().noise_Nm, 0.1);
  EXPECT_EQ(load_sim_config(bench, {{"noise_scale", 0.0}}).torque_sensor.value().noise_Nm, 0.0);
}

TEST(PlantChange, LyingTakesEveryJointsOwnAngleAndLetsTheTrunkGo) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  const PlantConfig hanging = load_sim_config(robot, {{"suspended", 0.8}}).plant;
  const PlantConfig lying = load_sim_config(robot, {{"lying", 1}}).plant;
  EXPECT_GT(hanging.suspended_m, 0.0);
  EXPECT_EQ(lying.suspended_m, 0.0);
  for (std::size_t j = 0; j < 12; ++j) EXPECT_EQ(lying.joints[j].initial_rad, hanging.joints[j].lying_rad);
  const RobotConfig leg = load_robot(test::source_dir() + "/robots/single_leg");
  EXPECT_THROW(load_sim_config(leg, {{"lying", 1}}), ConfigError);
}

TEST(PlantChange, ImuCanBeTakenOffAndNoiseScaleIsOnItsErrors) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  const ImuConfig plain = load_sim_config(robot, {}).imu.value();
  const ImuConfig loud = load_sim_config(robot, {{"noise_scale", 2}}).imu.value();
  EXPECT_GT(plain.rate_noise_rad_s, 0.0);
  EXPECT_EQ(loud.rate_noise_rad_s, 2 * plain.rate_noise_rad_s);
  EXPECT_EQ(loud.force_bias_m_s2, 2 * plain.force_bias_m_s2);
  EXPECT_EQ(loud.tilt_bias_rad, 2 * plain.tilt_bias_rad);
  EXPECT_EQ(loud.yaw_drift_rad_s, 2 * plain.yaw_drift_rad_s);
  EXPECT_FALSE(load_sim_config(robot, {{"imu", 0}}).imu);
  const RobotConfig leg = load_robot(test::source_dir() + "/robots/single_leg");
  EXPECT_THROW(load_sim_config(leg, {{"imu", 1}}), ConfigError);
}

}  // namespace
}  // namespace sprung::sim
