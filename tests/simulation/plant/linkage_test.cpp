/// pegasus with its knees driven through a parallelogram: the knee's motor turns with knee - hip.
#include "simulation/plant/linkage.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr std::size_t kHip = 1, kKnee = 2;  // of the front left leg

class LinkageTest : public testing::Test {
 protected:
  void make(bool parallelogram, std::map<std::string, double> changes) {
    RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
    if (parallelogram) {
      for (LegConfig& leg : robot.legs) leg.transmission = {1, 0, 0, 0, 1, 0, 0, 1, 1};
    }
    changes.emplace("suspended", 0.9);
    plant_.emplace(robot, load_sim_config(robot, changes).plant);
  }
  const SimTruth& truth() {
    plant_->fill_truth(truth_);
    return truth_;
  }
  void run(double seconds, const std::vector<double>& torque_Nm) {
    for (long i = std::lround(seconds / plant_->step_s()); i > 0; --i) plant_->step(torque_Nm);
    ASSERT_FALSE(plant_->failed()) << plant_->failure();
  }
  /// Joint torques of the front left leg's motors.
  static std::vector<double> motors(double hip_Nm, double knee_Nm, bool parallelogram) {
    std::vector<double> torque_Nm(12, 0.0);
    torque_Nm[kHip] = hip_Nm - (parallelogram ? knee_Nm : 0.0);
    torque_Nm[kKnee] = knee_Nm;
    return torque_Nm;
  }
  /// First acceleration of the front left foot under a force on it, beyond that without.
  Eigen::Vector3d answer(const Eigen::Vector3d& force_N, bool parallelogram) {
    Eigen::Vector3d change = Eigen::Vector3d::Zero();
    for (const double share : {0.0, 1.0}) {
      make(parallelogram, {{"friction_scale", 0.0}});
      const Vec3 start = truth().legs[0].true_foot_in_world_m;
      plant_->set_foot_wrench(0, {share * force_N[0], share * force_N[1], share * force_N[2], 0, 0, 0});
      plant_->step(std::vector<double>(12));
      const Vec3 end = truth().legs[0].true_foot_in_world_m;
      const double scale = (share > 0.0 ? 1.0 : -1.0) / (plant_->step_s() * plant_->step_s());
      change += scale * Eigen::Vector3d(end[0] - start[0], end[1] - start[1], end[2] - start[2]);
    }
    return change;
  }
  /// Vertical entry of the foot's mass matrix.
  double apparent_mass_kg(bool parallelogram) {
    Eigen::Matrix3d inverse;
    for (int axis = 0; axis < 3; ++axis)
      inverse.col(axis) = answer(10.0 * Eigen::Vector3d::Unit(axis), parallelogram) / 10.0;
    return inverse.inverse()(2, 2);
  }
  std::optional<Plant> plant_;
  SimTruth truth_{12, 4};
};

TEST_F(LinkageTest, KneesMotorTurnsTheShankAndLeavesTheThigh) {
  for (const bool parallelogram : {false, true}) {
    make(parallelogram, {{"friction_scale", 0.0}, {"armature_scale", 100.0}});  // rotors alone count
    run(0.05, motors(0.0, 81.0, parallelogram));
    const double hip = truth().joints[kHip].true_acceleration_rad_s2;
    EXPECT_NEAR(truth().joints[kKnee].true_acceleration_rad_s2, 1.0, 0.1);
    EXPECT_NEAR(hip, 0.0, 0.1);
    // And the hip's motor turns the thigh; the shank stays parallel to itself, or goes along.
    make(parallelogram, {{"friction_scale", 0.0}, {"armature_scale", 100.0}});
    run(0.05, motors(81.0, 0.0, parallelogram));
    EXPECT_NEAR(truth().joints[kHip].true_acceleration_rad_s2, 1.0, 0.1);
    EXPECT_NEAR(truth().joints[kKnee].true_acceleration_rad_s2, parallelogram ? 1.0 : 0.0, 0.1);
  }
}

TEST_F(LinkageTest, FootIsLessThanHalfAsHeavyAsWithASerialKnee) {
  // Closed form of facts A6 in the leg's plane; the rotors alone are 36.8 and 14.7 (facts physics 14).
  EXPECT_NEAR(apparent_mass_kg(false), 37.30, 0.01);
  EXPECT_NEAR(apparent_mass_kg(true), 15.21, 0.01);
}

TEST_F(LinkageTest, GearOfTheKneeSticksAtItsMotorWhileTheThighSwings) {
  make(true, {{"friction_scale", 1.0}});
  run(0.5, motors(0.0, 0.0, true));
  const double motor_rad = plant_->position_rad(kKnee) - plant_->position_rad(kHip);
  const double hip_rad = plant_->position_rad(kHip);
  run(0.5, motors(12.0, 0.0, true));
  EXPECT_GT(plant_->position_rad(kHip) - hip_rad, 0.1);
  EXPECT_NEAR(plant_->position_rad(kKnee) - plant_->position_rad(kHip), motor_rad, 1e-4);
  EXPECT_LT(std::abs(plant_->friction_torque_Nm(kKnee)), 4.3 * 1.1);
}

/// What the links feel, against the motors' torques less rotors and friction.
TEST_F(LinkageTest, GearOutputIsMotorLessRotorAndFrictionThroughTheLinkage) {
  make(true, {});
  run(0.2, motors(15.0, -14.0, true));
  const TrueJoint hip = truth().joints[kHip], knee = truth().joints[kKnee];
  const double knee_output_Nm = -14.0 -
                                0.81 * (knee.true_acceleration_rad_s2 - hip.true_acceleration_rad_s2) -
                                knee.true_friction_torque_Nm;
  EXPECT_NEAR(knee.true_gear_output_torque_Nm, knee_output_Nm, 1e-9);
  const double hip_output_Nm = 15.0 - 0.81 * hip.true_acceleration_rad_s2 - hip.true_friction_torque_Nm -
                               knee_output_Nm;
  EXPECT_NEAR(hip.true_gear_output_torque_Nm, hip_output_Nm, 1e-9);
  EXPECT_LT(knee.true_friction_torque_Nm, -3.0);  // it moves
}

TEST_F(LinkageTest, SecondLifeHasTheSameBits) {
  make(true, {});
  std::array<double, 12> first{};
  for (const bool again : {false, true}) {
    run(0.2, motors(15.0, -14.0, true));
    for (std::size_t j = 0; j < 12; ++j) {
      if (again) {
        EXPECT_EQ(plant_->position_rad(j), first[j]);
      }
      first[j] = plant_->position_rad(j);
    }
    plant_->reset();
  }
}

TEST_F(LinkageTest, TorsionBehindALinkageAndALinkageWithoutATendonAreRefused) {
  EXPECT_THROW(make(true, {{"torsion", 1.0}}), ConfigError);
  RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  robot.legs[0].transmission = {1, 0, 0, 1, 1, 0, 0, 0, 1};  // the hip's motor on the trunk
  EXPECT_THROW(Plant(robot, load_sim_config(robot, {}).plant), ConfigError);
}

}  // namespace
}  // namespace sprung::sim
