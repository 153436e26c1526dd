/// Gears that twist, in the plant: rotor and link apart, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr double kArm_kg_m2 = 0.510417;
constexpr double kRotor_kg_m2 = 0.72;
constexpr double kWeight_Nm = 3.5 * 9.81 * 0.371429;

/// The bench, its gear made to twist.
class TwistingAxis : public testing::Test {
 protected:
  Plant make(const TorsionConfig& torsion, std::map<std::string, double> changes = {}) {
    changes["torsion"] = 1.0;
    SimConfig config = load_sim_config(robot_, changes);
    config.plant.joints[0].torsion = torsion;
    return Plant(robot_, config.plant);
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/test_axis");
};

TEST_F(TwistingAxis, StaticTwistIsLoadOverStiffness) {
  Plant plant = make({2.5e4, 2.5e4, 0.0, 200.0}, {{"friction_scale", 0.0}});
  for (int i = 0; i < 80000; ++i)
    plant.step({300.0 * (1.0 - plant.motor_position_rad(0)) - 40.0 * plant.motor_velocity_rad_s(0)});
  const double load_Nm = kWeight_Nm * std::sin(plant.position_rad(0));
  EXPECT_NEAR(plant.gear_output_torque_Nm(0), load_Nm, 1e-3);
  EXPECT_NEAR(plant.motor_position_rad(0) - plant.position_rad(0), load_Nm / 2.5e4, 1e-7);
}

/// Two free masses on a spring swing at sqrt(K (1/J + 1/m)); weight and friction left out.
TEST_F(TwistingAxis, SwingsAtTheFrequencyOfTwoMasses) {
  Plant plant = make({2.5e4, 2.5e4, 0.0, 0.0}, {{"friction_scale", 0.0}, {"mass_scale", 1.0}});
  for (int i = 0; i < 4; ++i) plant.step({150.0});  // a knock on the rotor
  int crossings = 0;
  double first_s = 0.0, last_s = 0.0, before = 0.0;
  for (int i = 0; i < 8000; ++i) {
    plant.step({0.0});
    const double twist = plant.motor_position_rad(0) - plant.position_rad(0);
    if (before < 0.0 && twist >= 0.0) {
      last_s = plant.step_s() * (i + before / (before - twist));
      if (crossings++ == 0) first_s = last_s;
    }
    before = twist;
  }
  const double expected_Hz = std::sqrt(2.5e4 * (1.0 / kArm_kg_m2 + 1.0 / kRotor_kg_m2)) / (2.0 * M_PI);
  EXPECT_NEAR((crossings - 1) / (last_s - first_s), expected_Hz, 0.005 * expected_Hz);
}

/// Rotor, spring, arm and weight together: the sum stays.
TEST_F(TwistingAxis, EnergyStaysWithoutFriction) {
  Plant plant = make({2.5e4, 3.4e4, 14.0, 0.0}, {{"friction_scale", 0.0}});
  const auto energy_J = [&] {
    const double twist = std::abs(plant.motor_position_rad(0) - plant.position_rad(0));
    const double soft = std::min(twist, 14.0 / 2.5e4), hard = twist - soft;
    const double spring_J = 0.5 * 2.5e4 * soft * soft + 14.0 * hard + 0.5 * 3.4e4 * hard * hard;
    return 0.5 * kRotor_kg_m2 * std::pow(plant.motor_velocity_rad_s(0), 2) +
           0.5 * kArm_kg_m2 * std::pow(plant.velocity_rad_s(0), 2) + spring_J -
           kWeight_Nm * std::cos(plant.position_rad(0));
  };
  for (int i = 0; i < 400; ++i) plant.step({60.0});
  const double start_J = energy_J();
  for (int i = 0; i < 20000; ++i) {
    plant.step({0.0});
    ASSERT_NEAR(energy_J(), start_J, 0.02 * std::abs(start_J) + 0.05) << i;
  }
}

TEST_F(TwistingAxis, RotorSticksExactlyWhileTheArmRests) {
  Plant plant = make({2.5e4, 2.5e4, 0.0, 50.0});
  for (int i = 0; i < 8000; ++i) plant.step({0.9 * 5.6});
  const double stuck_rad = plant.motor_position_rad(0);
  for (int i = 0; i < 40000; ++i) plant.step({0.9 * 5.6});
  EXPECT_EQ(plant.motor_position_rad(0), stuck_rad);
  EXPECT_NEAR(plant.friction_torque_Nm(0) + plant.gear_output_torque_Nm(0), 0.9 * 5.6, 1e-9);
}

/// What the link feels is what accelerates it: an independent balance from the truth's acceleration.
TEST_F(TwistingAxis, OutputTorqueIsWhatAcceleratesTheArm) {
  Plant plant = make({2.5e4, 2.5e4, 0.0, 50.0});
  SimTruth truth(1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double before_rad = plant.position_rad(0);
    plant.step({50.0 * std::sin(0.02 * i)});
    plant.fill_truth(truth);
    const TrueJoint& joint = truth.joints[0];
    ASSERT_NEAR(joint.true_gear_output_torque_Nm,
                kArm_kg_m2 * joint.true_acceleration_rad_s2 + kWeight_Nm * std::sin(before_rad), 1e-3);
  }
  EXPECT_NE(truth.joints[0].true_motor_position_rad, truth.joints[0].true_position_rad);
}

TEST_F(TwistingAxis, RigidGearsMoveAsOne) {
  Plant plant(robot_, load_sim_config(robot_, {}).plant);
  for (int i = 0; i < 1000; ++i) plant.step({30.0});
  EXPECT_EQ(plant.motor_position_rad(0), plant.position_rad(0));
  EXPECT_EQ(plant.motor_velocity_rad_s(0), plant.velocity_rad_s(0));
}

/// Twelve gears that twist, standing on soft feet: stable at the shipped step, the same bits after a reset.
TEST(TwistingPegasus, StandsOnItsFeetAndRepeatsItsBits) {
  const RobotConfig robot = load_robot("pegasus");
  const SimConfig config = load_sim_config(robot, {{"torsion", 1.0}, {"suspended", 0.0}});
  ASSERT_TRUE(config.plant.joints[0].torsion.has_value());
  Plant plant(robot, config.plant);
  std::vector<double> torque_Nm(robot.joints.size());
  SimTruth truth(robot.joints.size(), robot.legs.size());
  const auto life = [&] {
    for (int i = 0; i < 4000; ++i) {
      for (std::size_t j = 0; j < torque_Nm.size(); ++j)
        torque_Nm[j] = 500.0 * (config.plant.joints[j].initial_rad - plant.motor_position_rad(j)) -
                       30.0 * plant.motor_velocity_rad_s(j);
      plant.step(torque_Nm);
    }
    ASSERT_FALSE(plant.failed()) << plant.failure();
    plant.fill_truth(truth);
  };
  life();
  const SimTruth first = truth;
  double carried_N = 0.0;
  for (const TrueLeg& leg : first.legs) carried_N += leg.true_contact_force_N[2];
  EXPECT_NEAR(carried_N, 30.0 * 9.81, 5.0);
  EXPECT_GT(first.base_in_world_m[2], 0.45);
  const TrueJoint& knee = first.joints[2];
  EXPECT_NEAR(std::abs(knee.true_motor_position_rad - knee.true_position_rad),
              std::abs(knee.true_gear_output_torque_Nm) / 2.5e4, 1e-5)
      << "below 14 Nm the first stiffness holds";
  plant.reset();
  life();
  EXPECT_EQ(first.base_in_world_m, truth.base_in_world_m);
  EXPECT_EQ(first.joints[2].true_motor_position_rad, truth.joints[2].true_motor_position_rad);
}

TEST(TwistingPegasus, GearsAreRigidUnlessTorsionIsAskedFor) {
  const RobotConfig robot = load_robot("pegasus");
  for (const bool asked : {false, true}) {
    const auto changes = asked ? std::map<std::string, double>{{"torsion", 1.0}}
                               : std::map<std::string, double>{};
    Plant plant(robot, load_sim_config(robot, changes).plant);
    for (int i = 0; i < 100; ++i) plant.step(std::vector<double>(robot.joints.size(), 30.0));
    EXPECT_EQ(plant.motor_position_rad(2) != plant.position_rad(2), asked);
  }
  EXPECT_THROW(load_sim_config(load_robot("fennec"), {{"torsion", 1.0}}), ConfigError);
}

}  // namespace
}  // namespace sprung::sim
