/// test_axis as a plant: what its arm, gear and torque sensor do, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr double kAxisWeight_Nm = 3.5 * 9.81 * 0.371429;  // level arm
constexpr double kAxisArm_kg_m2 = 0.510417;
constexpr double kAxisRotor_kg_m2 = 0.72;

class TestAxisPlant : public testing::Test {
 protected:
  Plant make(const std::map<std::string, double>& changes = {}) {
    return Plant(robot_, load_sim_config(robot_, changes).plant);
  }
  void run(Plant& plant, double seconds, double torque_Nm) {
    for (long i = std::lround(seconds / plant.step_s()); i > 0; --i) plant.step({torque_Nm});
    ASSERT_FALSE(plant.failed()) << plant.failure();
  }
  /// Motor torque that keeps the arm at a speed, by a velocity loop, until `to_rad`. @return mean over the
  /// last half of the way of motor torque less weight: friction.
  double friction_at(Plant& plant, double speed_rad_s, double to_rad) {
    double sum_Nm = 0.0;
    int count = 0;
    const double from_rad = plant.position_rad(0);
    double held_Nm = 0.0;
    for (int i = 0; i < 400000 && (to_rad - plant.position_rad(0)) * speed_rad_s > 0.0; ++i) {
      const double error = speed_rad_s - plant.velocity_rad_s(0);
      held_Nm += 2000.0 * error * plant.step_s();
      plant.step({held_Nm + 80.0 * error});
      const double way = (plant.position_rad(0) - from_rad) / (to_rad - from_rad);
      if (way < 0.5) continue;
      sum_Nm += plant.friction_torque_Nm(0);
      ++count;
    }
    return sum_Nm / count;
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/test_axis");
};

TEST_F(TestAxisPlant, HangsStillAndItsEndIsWhereTheControllersHaveIt) {
  Plant plant = make();
  run(plant, 0.5, 0.0);
  SimTruth truth(1, 1);
  plant.fill_truth(truth);
  EXPECT_NEAR(plant.position_rad(0), 0.0, 1e-9);
  EXPECT_NEAR(truth.legs[0].true_foot_in_world_m[2], 1.0 - 0.4, 1e-9);
  EXPECT_EQ(truth.base_in_world_m[2], 1.0);
}

TEST_F(TestAxisPlant, PositiveTorqueSwingsItTowardXAndTheWeightIsWhatWasWeighed) {
  Plant plant = make({{"friction_scale", 0.0}});
  run(plant, 1.0, 0.0);
  double held_Nm = 0.0;
  for (int i = 0; i < 40000; ++i) {  // a damped spring to level
    held_Nm = 300.0 * (M_PI / 2 - plant.position_rad(0)) - 40.0 * plant.velocity_rad_s(0);
    plant.step({held_Nm});
  }
  SimTruth truth(1, 1);
  plant.fill_truth(truth);
  EXPECT_GT(truth.legs[0].true_foot_in_world_m[0], 0.39);
  EXPECT_NEAR(held_Nm, kAxisWeight_Nm * std::sin(plant.position_rad(0)), 1e-3);
  EXPECT_NEAR(plant.gear_output_torque_Nm(0), held_Nm, 1e-3);
}

TEST_F(TestAxisPlant, RotorAndArmShareTheTorqueByTheirInertias) {
  Plant plant = make({{"friction_scale", 0.0}});
  plant.step({10.0});
  EXPECT_NEAR(plant.gear_output_torque_Nm(0), 10.0 * kAxisArm_kg_m2 / (kAxisArm_kg_m2 + kAxisRotor_kg_m2),
              1e-3);
}

TEST_F(TestAxisPlant, FrictionFollowsItsLawOfSpeedAndDirection) {
  for (const double speed : {0.5, 2.0, -0.5, -2.0}) {
    Plant plant = make({{"load_share_scale", 0.0}, {"heating_scale", 0.0}});
    const double direction = speed > 0.0 ? 1.0 : -1.0;
    const double expected = (1.0 + 0.05 * direction) *
                            (4.83 + 0.77 * std::exp(-std::pow(speed / 0.15, 2)) + 7.4 * std::abs(speed));
    EXPECT_NEAR(friction_at(plant, speed, 2.5 * direction), direction * expected, 0.01 * expected) << speed;
  }
}

/// Up against the weight the gear drives, down the weight drives the gear: the shares differ.
TEST_F(TestAxisPlant, LoadFrictionKnowsWhoDrives) {
  const std::map<std::string, double> only_load = {{"coulomb_scale", 0.0}, {"viscous_scale", 0.0}};
  Plant plant = make(only_load);
  const auto ratio = [&](double speed, double to_rad) {
    double worst = 0.0;
    (void)friction_at(plant, speed, to_rad);
    worst = std::abs(plant.friction_torque_Nm(0) / plant.gear_output_torque_Nm(0));
    return worst;
  };
  EXPECT_NEAR(ratio(0.5, 1.5), 1.05 * 0.13, 0.002) << "upward";
  EXPECT_NEAR(ratio(-0.5, 1.0), 0.95 * 0.166, 0.002) << "downward";
}

TEST_F(TestAxisPlant, StickHoldsExactlyUnderTheRichLaw) {
  Plant plant = make();
  run(plant, 1.0, 4.0);
  const double stuck_rad = plant.position_rad(0);
  run(plant, 10.0, 0.9 * 5.6);
  EXPECT_NEAR(plant.position_rad(0), stuck_rad, 1e-5);
  run(plant, 1.0, 1.2 * 5.6 * 1.05);
  EXPECT_GT(plant.position_rad(0), stuck_rad + 0.02);
}

TEST_F(TestAxisPlant, WarmthComesFromFrictionAndThinsIt) {
  Plant cold = make();
  Plant warm = make({{"temperature", 50.0}});
  EXPECT_EQ(warm.temperature_degC(0), 50.0);
  EXPECT_EQ(cold.temperature_degC(0), 24.0);
  const double cold_Nm = friction_at(cold, 2.0, 2.5);
  const double warm_Nm = friction_at(warm, 2.0, 2.5);
  const double factor = std::exp(-0.03 * 26.0);
  const double expected_drop_Nm = 1.05 * (1.0 - factor) * (7.4 * 2.0 + 0.2 * 4.83);
  EXPECT_NEAR(cold_Nm - warm_Nm, expected_drop_Nm, 0.05 * expected_drop_Nm);
  EXPECT_GT(cold.temperature_degC(0), 24.0);
  const double loss_J = cold_Nm * 2.5;
  EXPECT_NEAR(cold.temperature_degC(0) - 24.0, loss_J * 0.6 / 1200.0, 0.2 * loss_J * 0.6 / 1200.0);
}

TEST_F(TestAxisPlant, HeatIsForgottenByAResetAndTheSecondLifeHasTheSameBits) {
  Plant plant = make();
  const auto life = [&] {
    for (int i = 0; i < 4000; ++i) plant.step({40.0 * std::sin(0.01 * i)});
    SimTruth truth(1, 1);
    plant.fill_truth(truth);
    return truth.joints[0];
  };
  const TrueJoint first = life();
  EXPECT_GT(first.true_temperature_degC, 24.0);
  plant.reset();
  const TrueJoint second = life();
  EXPECT_EQ(first.true_position_rad, second.true_position_rad);
  EXPECT_EQ(first.true_friction_torque_Nm, second.true_friction_torque_Nm);
  EXPECT_EQ(first.true_temperature_degC, second.true_temperature_degC);
}

TEST_F(TestAxisPlant, PushAtTheEndOfTheArmIsLeverTimesForce) {
  Plant plant = make({{"friction_scale", 0.0}});
  plant.set_foot_wrench(0, {10, 0, 0, 0, 0, 0});
  plant.step({0.0});
  SimTruth truth(1, 1);
  plant.fill_truth(truth);
  EXPECT_NEAR(truth.joints[0].true_acceleration_rad_s2, 10.0 * 0.4 / (kAxisArm_kg_m2 + kAxisRotor_kg_m2),
              1e-3);
}

TEST_F(TestAxisPlant, BenchIsBoltedDown) {
  Plant plant = make();
  plant.suspend(2.0);
  plant.set_base_wrench({1000, 0, 1000, 0, 0, 0});
  run(plant, 0.1, 0.0);
  SimTruth truth(1, 1);
  plant.fill_truth(truth);
  EXPECT_EQ(truth.base_in_world_m, (Vec3{0, 0, 1}));
  plant.release();
  run(plant, 0.1, 0.0);
}

}  // namespace
}  // namespace sprung::sim
