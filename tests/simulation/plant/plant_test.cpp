#include "simulation/plant/plant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr double kGravity_m_s2 = 9.81;

class PlantTest : public testing::Test {
 protected:
  /// The shipped plant, with changes as by --plant.
  Plant make(const std::map<std::string, double>& changes = {}) {
    return Plant(robot_, load_sim_config(robot_, changes).plant);
  }
  SimTruth truth(Plant& plant) {
    SimTruth truth(robot_.joints.size(), robot_.legs.size());
    plant.fill_truth(truth);
    return truth;
  }
  void run(Plant& plant, double seconds, const std::vector<double>& torque_Nm = {0.0, 0.0}) {
    for (long i = std::lround(seconds / plant.step_s()); i > 0; --i) plant.step(torque_Nm);
    ASSERT_FALSE(plant.failed()) << plant.failure();
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/single_leg");
};

TEST_F(PlantTest, StartsWithTheFootUnderTheHipOnTheFloor) {
  Plant plant = make();
  const SimTruth start = truth(plant);
  EXPECT_NEAR(start.legs[0].true_foot_in_world_m[0], start.base_in_world_m[0], 1e-3);
  EXPECT_NEAR(start.legs[0].true_foot_in_world_m[2], 0.02, 1e-9);  // centre of the foot's ball
  EXPECT_NEAR(start.base_in_world_m[2] - start.legs[0].true_foot_in_world_m[2], 0.300, 1e-3);
}

TEST_F(PlantTest, AWornFootIsSmaller) {
  Plant plant = make({{"foot_radius_scale", 0.75}});
  EXPECT_NEAR(truth(plant).legs[0].true_foot_in_world_m[2], 0.015, 1e-9);
}

TEST_F(PlantTest, FootFollowsThePapersKinematics) {
  Plant plant = make();
  const SimTruth pose = truth(plant);
  const double thigh = pose.joints[0].true_position_rad;
  const double shank = thigh - pose.joints[1].true_position_rad;
  const LegConfig& leg = robot_.legs[0];
  const double x = leg.links[0].length_m * std::cos(thigh) + leg.links[1].length_m * std::cos(shank);
  const double down = leg.links[0].length_m * std::sin(thigh) + leg.links[1].length_m * std::sin(shank);
  EXPECT_NEAR(pose.legs[0].true_foot_in_world_m[0] - pose.base_in_world_m[0], x, 1e-12);
  EXPECT_NEAR(pose.base_in_world_m[2] - pose.legs[0].true_foot_in_world_m[2], down, 1e-12);
}

TEST_F(PlantTest, NinetyPercentOfStickHoldsForTenSeconds) {
  Plant plant = make({{"mass_scale", 1.0}});
  plant.suspend(1.0);
  run(plant, 2.0);  // the leg sinks until friction holds it
  const double hip_rad = plant.position_rad(0);
  const double knee_rad = plant.position_rad(1);
  // Gravity's part of the friction is known; add motor torque up to 90 % of stick in the knee.
  const double extra_Nm = 0.9 * 7.3 - plant.friction_torque_Nm(1);
  run(plant, 10.0, {0.0, extra_Nm});
  EXPECT_NEAR(plant.friction_torque_Nm(1), 0.9 * 7.3, 0.02);
  EXPECT_NEAR(plant.position_rad(0), hip_rad, 1e-5);
  EXPECT_NEAR(plant.position_rad(1), knee_rad, 1e-5);
}

TEST_F(PlantTest, MoreThanStickMoves) {
  Plant plant = make();
  plant.suspend(1.0);
  run(plant, 2.0);
  const double knee_rad = plant.position_rad(1);
  run(plant, 0.5, {0.0, -1.1 * 7.3 - plant.friction_torque_Nm(1) - 1.0});
  EXPECT_LT(plant.position_rad(1), knee_rad - 0.05);
}

/// Height of the foot's ball under a static vertical load, the leg held by its stops and friction.
TEST_F(PlantTest, StaticContactStiffnessIsInNewtonsPerMetre) {
  for (const double stiffness : {8200.0, 30000.0}) {
    Plant plant = make({{"ground_stiffness", stiffness}, {"friction_scale", 50.0}});
    run(plant, 2.0);
    const double light_m = truth(plant).legs[0].true_foot_in_world_m[2];
    const double light_N = truth(plant).legs[0].true_contact_force_N[2];
    plant.set_base_wrench({0, 0, -100, 0, 0, 0});
    run(plant, 2.0);
    const SimTruth loaded = truth(plant);
    const double sunk_m = light_m - loaded.legs[0].true_foot_in_world_m[2];
    EXPECT_NEAR(light_N, 5.23 * kGravity_m_s2, 0.05);
    EXPECT_NEAR(loaded.legs[0].true_contact_force_N[2] - light_N, 100.0, 0.1);
    EXPECT_NEAR(100.0 / sunk_m, stiffness, 0.02 * stiffness);
  }
}

TEST_F(PlantTest, LiftedRobotFallsFreely) {
  Plant plant = make();
  plant.suspend(1.5);
  plant.release();
  run(plant, 0.2);
  const SimTruth fallen = truth(plant);
  EXPECT_NEAR(1.5 - fallen.base_in_world_m[2], 0.5 * kGravity_m_s2 * 0.04, 0.003);
  EXPECT_NEAR(fallen.base_velocity_m_s[2], -kGravity_m_s2 * 0.2, 1e-2);
  EXPECT_EQ(fallen.legs[0].true_contact_force_N[2], 0.0);
}

TEST_F(PlantTest, LockedRailHoldsXAndFreeRailDoesNot) {
  for (const double locked : {1.0, 0.0}) {
    Plant plant = make({{"rail_x_locked", locked}});
    plant.set_base_wrench({50, 0, 0, 0, 0, 0});
    run(plant, 0.3);
    const double moved_m = truth(plant).base_in_world_m[0];
    if (locked != 0.0) {
      EXPECT_NEAR(moved_m, 0.0, 1e-6);
    } else {
      EXPECT_GT(moved_m, 0.01);
    }
  }
}

TEST_F(PlantTest, ArmatureCarriesTheTorqueWithoutGravityOrFriction) {
  Plant plant = make({{"friction_scale", 0.0}, {"armature_scale", 100.0}});
  plant.suspend(1.0);
  plant.step({0.0, -81.0});  // 81 kg m^2 of rotor against 0.02 of shank
  EXPECT_NEAR(truth(plant).joints[1].true_acceleration_rad_s2, -1.0, 0.03);
}

/// Energy of the swinging leg by the closed form of facts A6, friction-free: an independent model.
TEST_F(PlantTest, FrictionlessSwingKeepsItsEnergy) {
  Plant plant = make({{"friction_scale", 0.0}, {"armature_scale", 0.05}});
  plant.suspend(1.5);
  const auto energy_J = [&] {
    const LinkConfig& thigh = robot_.legs[0].links[0];
    const LinkConfig& shank = robot_.legs[0].links[1];
    const double l1 = thigh.length_m;
    const double c1 = thigh.com_m;
    const double c2 = shank.com_m;
    const double rotor = 0.81 * 0.05;
    const double knee = plant.position_rad(1);
    const double m11 = rotor + thigh.inertia_kg_m2 + shank.inertia_kg_m2 + thigh.mass_kg * c1 * c1 +
                       shank.mass_kg * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * std::cos(knee));
    const double m12 = -(shank.inertia_kg_m2 + shank.mass_kg * c2 * (c2 + l1 * std::cos(knee)));
    const double m22 = rotor + shank.inertia_kg_m2 + shank.mass_kg * c2 * c2;
    const double w1 = plant.velocity_rad_s(0);
    const double w2 = plant.velocity_rad_s(1);
    const double s1 = std::sin(plant.position_rad(0));
    const double s12 = std::sin(plant.position_rad(0) - knee);
    const double height = -thigh.mass_kg * c1 * s1 -
                          shank.mass_kg * (l1 * s1 + c2 * s12);  // theta positive downward
    return 0.5 * m11 * w1 * w1 + m12 * w1 * w2 + 0.5 * m22 * w2 * w2 + kGravity_m_s2 * height;
  };
  const double start_J = energy_J();
  double fastest_rad_s = 0.0;
  for (int i = 0; i < 1600; ++i) {
    plant.step({0.0, 0.0});
    fastest_rad_s = std::max(fastest_rad_s, std::abs(plant.velocity_rad_s(0)));
    ASSERT_NEAR(energy_J(), start_J, 0.01) << "step " << i;
  }
  EXPECT_GT(fastest_rad_s, 3.0);  // it did swing
}

TEST_F(PlantTest, FrictionOnlyTakesEnergy) {
  Plant plant = make();
  plant.suspend(1.5);
  for (int i = 0; i < 2000; ++i) {
    plant.step({10.0 * std::sin(0.01 * i), 0.0});
    ASSERT_GE(plant.friction_torque_Nm(0) * plant.velocity_rad_s(0), -1e-6);
    ASSERT_LE(std::abs(plant.friction_torque_Nm(0)), 7.3 * 1.001);
  }
}

TEST_F(PlantTest, GearOutputTorqueIsTheStaticLoadAtRest) {
  Plant plant = make({{"friction_scale", 0.0}});
  plant.suspend(1.0);
  // Closed form: knee gravity torque m2 g c2 cos(theta1 - theta2), errata E1; the motor holds exactly that
  // for an instant.
  const double shank_rad = plant.position_rad(0) - plant.position_rad(1);
  const double gravity_Nm = 0.30 * kGravity_m_s2 * 0.211 * std::cos(shank_rad);
  const double thigh_Nm = -(0.80 * 0.130 + 0.30 * 0.260) * kGravity_m_s2 * std::cos(plant.position_rad(0)) -
                          gravity_Nm;
  plant.step({thigh_Nm, gravity_Nm});
  EXPECT_NEAR(plant.gear_output_torque_Nm(1), gravity_Nm, 1e-3);
  EXPECT_NEAR(plant.gear_output_torque_Nm(0), thigh_Nm, 1e-3);
}

TEST_F(PlantTest, GearOutputTorqueLeavesOutWhatTheRotorTakes) {
  Plant plant = make({{"friction_scale", 0.0}});
  plant.suspend(1.0);
  plant.step({0.0, -100.0});
  const SimTruth moving = truth(plant);
  const double rotor_Nm = 0.81 * moving.joints[1].true_acceleration_rad_s2;
  EXPECT_NEAR(moving.joints[1].true_gear_output_torque_Nm, -100.0 - rotor_Nm, 1e-9);
  EXPECT_LT(std::abs(moving.joints[1].true_gear_output_torque_Nm), 10.0);  // the shank alone is light
}

TEST_F(PlantTest, StribeckAndLoadRaiseFriction) {
  SimConfig config = load_sim_config(robot_, {});
  for (PlantJointConfig& joint : config.plant.joints) {
    joint.friction.breakaway_Nm = 10.0;
    joint.friction.driving_share = joint.friction.back_driving_share = 0.1;
  }
  Plant plant(robot_, config.plant);
  plant.suspend(1.0);
  run(plant, 1.0);
  const double held_rad = plant.position_rad(1);
  run(plant, 0.5, {0.0, -8.5});  // above Coulomb's 7.3, below breakaway
  EXPECT_NEAR(plant.position_rad(1), held_rad, 1e-4);
}

TEST_F(PlantTest, EndStopsHold) {
  Plant plant = make();
  plant.suspend(1.0);
  run(plant, 1.0, {0.0, 60.0});
  EXPECT_NEAR(plant.position_rad(1), 2.6, 0.02);
}

TEST_F(PlantTest, ResetGivesTheSameBitsAgain) {
  Plant plant = make();
  const auto life = [&] {
    plant.suspend(0.6);
    plant.set_foot_wrench(0, {5, 0, 20, 0, 0, 0});
    run(plant, 0.1, {20.0, -30.0});
    plant.release();
    run(plant, 0.4, {3.0, -20.0});
    return truth(plant);
  };
  const SimTruth first = life();
  plant.reset();
  const SimTruth second = life();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(first.joints[i].true_position_rad, second.joints[i].true_position_rad);
    EXPECT_EQ(first.joints[i].true_acceleration_rad_s2, second.joints[i].true_acceleration_rad_s2);
  }
  EXPECT_EQ(first.base_in_world_m, second.base_in_world_m);
}

TEST_F(PlantTest, AskingForTheTruthChangesNoBit) {
  Plant asked = make();
  Plant left_alone = make();
  for (Plant* plant : {&asked, &left_alone}) plant->set_foot_wrench(0, {5, 0, 20, 0, 0, 0});
  for (int i = 0; i < 800; ++i) {
    asked.step({5.0, -25.0});
    left_alone.step({5.0, -25.0});
    truth(asked);
  }
  EXPECT_EQ(asked.position_rad(0), left_alone.position_rad(0));
  EXPECT_EQ(asked.velocity_rad_s(1), left_alone.velocity_rad_s(1));
}

TEST_F(PlantTest, NotFiniteTorqueFailsTheRun) {
  Plant plant = make();
  plant.step({std::nan(""), 0.0});
  plant.step({0.0, 0.0});
  EXPECT_TRUE(plant.failed());
  EXPECT_NE(std::string(plant.failure()).find("MuJoCo"), std::string::npos);
}

TEST_F(PlantTest, FloorHeightMovesFloorAndStart) {
  Plant low = make();
  Plant high = make({{"floor_height", 0.25}});
  EXPECT_NEAR(truth(high).base_in_world_m[2] - truth(low).base_in_world_m[2], 0.25, 1e-9);
  run(high, 1.0);
  EXPECT_NEAR(truth(high).legs[0].true_contact_force_N[2], 5.23 * kGravity_m_s2, 5.0);
}

TEST_F(PlantTest, ModelWithoutAJointOfTheRobotIsRefused) {
  robot_.joints[1].name = "elbow";
  SimConfig config = load_sim_config(load_robot(robot_.folder), {});
  EXPECT_THROW(Plant(robot_, config.plant), ConfigError);
}

/// A robot that is hung up: feet in the air, the trunk where it was put, also after a reset.
TEST(SuspendedPlant, TrunkStaysWhileTheLegsMove) {
  const RobotConfig robot = load_robot("pegasus");
  Plant plant(robot, load_sim_config(robot, {{"suspended", 0.8}}).plant);
  SimTruth truth(robot.joints.size(), robot.legs.size());
  std::vector<double> torque_Nm(robot.joints.size(), 20.0);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 2000; ++i) plant.step(torque_Nm);
    ASSERT_FALSE(plant.failed()) << plant.failure();
    plant.fill_truth(truth);
    EXPECT_NEAR(truth.base_in_world_m[2], 0.80, 1e-4);
    EXPECT_NEAR(truth.base_quaternion_wxyz[0], 1.0, 1e-6);
    for (const TrueLeg& leg : truth.legs) EXPECT_GT(leg.true_foot_in_world_m[2], 0.1);
    EXPECT_GT(std::abs(truth.joints[1].true_position_rad - 2.1565), 0.05);
    plant.reset();
  }
}

TEST(SuspendedPlant, LegsAreMirroredAndFeetAreUnderTheHips) {
  const RobotConfig robot = load_robot("pegasus");
  Plant plant(robot, load_sim_config(robot, {{"suspended", 0.8}}).plant);
  SimTruth truth(robot.joints.size(), robot.legs.size());
  plant.fill_truth(truth);
  const double hip_x[] = {0.33, 0.33, -0.33, -0.33}, hip_y[] = {0.20, -0.20, 0.20, -0.20};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const Vec3& foot = truth.legs[leg].true_foot_in_world_m;
    EXPECT_NEAR(foot[0], hip_x[leg], 1e-3);
    EXPECT_NEAR(foot[1], hip_y[leg], 1e-9);
    EXPECT_NEAR(foot[2], 0.80 - 0.50, 1e-3);
  }
}

}  // namespace
}  // namespace sprung::sim
