/// pegasus as a whole: a free trunk on four legs.
#include <gtest/gtest.h>

#include <cmath>

#include "model/three_joint.h"
#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr double kWeight_N = 30.0 * 9.81;

class PegasusPlant : public testing::Test {
 protected:
  void make(std::map<std::string, double> changes = {}) {
    changes.emplace("suspended", 0.0);
    plant_.emplace(robot_, load_sim_config(robot_, changes).plant);
    for (std::size_t j = 0; j < 12; ++j) target_rad_[j] = plant_->position_rad(j);
  }
  const SimTruth& truth() {
    plant_->fill_truth(truth_);
    return truth_;
  }
  /// Cosine between the trunk's up and the world's.
  double up() {
    const auto& q = truth().base_quaternion_wxyz;
    return q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3];
  }
  /// Joints held as robot.yaml's position loop does.
  void hold(double seconds) {
    std::vector<double> torque_Nm(12);
    for (long i = std::lround(seconds / plant_->step_s()); i > 0; --i) {
      for (std::size_t j = 0; j < 12; ++j) {
        const ActuatorConfig& a = robot_.actuators[j];
        torque_Nm[j] = a.position_stiffness_Nm_rad * (target_rad_[j] - plant_->position_rad(j)) -
                       a.position_damping_Nm_s_rad * plant_->velocity_rad_s(j);
      }
      plant_->step(torque_Nm);
    }
    ASSERT_FALSE(plant_->failed()) << plant_->failure();
  }
  void rest(double seconds) {
    for (long i = std::lround(seconds / plant_->step_s()); i > 0; --i) plant_->step(std::vector<double>(12));
    ASSERT_FALSE(plant_->failed()) << plant_->failure();
  }
  Vec3 ground_force_N() {
    Vec3 sum{};
    for (const TrueLeg& leg : truth().legs) {
      for (std::size_t i = 0; i < 3; ++i) sum[i] += leg.true_contact_force_N[i];
    }
    return sum;
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/pegasus");
  std::optional<Plant> plant_;
  std::array<double, 12> target_rad_{};
  SimTruth truth_{12, 4};
};

TEST_F(PegasusPlant, StandsOnHeldJointsAndTheFeetCarryItsWeight) {
  make();
  EXPECT_NEAR(truth().base_in_world_m[2], 0.52, 1e-3);  // legs of 0.5 m and the feet's radius
  hold(1.5);
  const Vec3 force_N = ground_force_N();
  EXPECT_NEAR(force_N[2], kWeight_N, 0.1);
  EXPECT_NEAR(force_N[0], 0.0, 0.1);
  EXPECT_NEAR(force_N[1], 0.0, 0.1);
  EXPECT_GT(truth().base_in_world_m[2], 0.48);
  EXPECT_GT(truth().base_quaternion_wxyz[0], 0.9999);
  for (const TrueLeg& leg : truth().legs) {
    EXPECT_GT(leg.true_contact_force_N[2], 50.0);
    EXPECT_EQ(leg.true_ground_height_m, 0.0);
  }
}

TEST_F(PegasusPlant, FallsAsOneBodyOfThirtyKilograms) {
  make();
  EXPECT_EQ(truth().true_base_contact_force_N, Vec3{}) << "its feet carry it";
  plant_->suspend(1.5);
  plant_->release();
  hold(0.2);
  EXPECT_NEAR(truth().com_velocity_m_s[2], -9.81 * 0.2, 1e-6);
  EXPECT_EQ(ground_force_N()[2], 0.0);
}

TEST_F(PegasusPlant, ImpulseOnTheTrunkChangesTheMomentumByAsMuch) {
  make();
  plant_->suspend(1.5);
  plant_->release();
  plant_->set_base_wrench({0, 300, 0, 0, 0, 0});
  hold(0.1);
  plant_->set_base_wrench({});
  EXPECT_NEAR(30.0 * truth().com_velocity_m_s[1], 30.0, 1e-4);  // N s
  EXPECT_NEAR(truth().com_velocity_m_s[0], 0.0, 1e-5);
}

TEST_F(PegasusPlant, PushedDownTheFeetCarryThePushToo) {
  make();
  hold(1.0);
  plant_->set_base_wrench({0, 0, -150, 0, 0, 0});
  hold(1.5);
  EXPECT_NEAR(ground_force_N()[2], kWeight_N + 150.0, 0.3);
  plant_->set_base_wrench({0, 0, 400, 0, 0, 0});
  hold(0.3);
  EXPECT_EQ(ground_force_N()[2], 0.0);
  EXPECT_GT(truth().base_velocity_m_s[2], 0.0);
}

TEST_F(PegasusPlant, LiesFlatOnItsSkidsWithEveryJointInsideRobotYamlsLimits) {
  make({{"lying", 1}});
  rest(2.0);
  EXPECT_NEAR(truth().base_in_world_m[2], 0.14, 0.005);
  EXPECT_GT(truth().base_quaternion_wxyz[0], 0.999);
  EXPECT_LT(ground_force_N()[2], 0.5 * kWeight_N);  // the skids carry the rest
  for (std::size_t j = 0; j < 12; ++j) {
    EXPECT_GT(plant_->position_rad(j), robot_.joints[j].position_min_rad) << robot_.joints[j].name;
    EXPECT_LT(plant_->position_rad(j), robot_.joints[j].position_max_rad) << robot_.joints[j].name;
  }
}

TEST_F(PegasusPlant, RolledItLiesOnItsSideOrItsBackAndStaysThere) {
  for (const double roll_rad : {1.57, -1.57, 3.14}) {
    make({{"lying", 1}, {"roll", roll_rad}});
    EXPECT_NEAR(up(), std::cos(roll_rad), 1e-9);
    rest(2.0);  // on its side it may topple, but not onto its feet
    EXPECT_LT(up(), 0.4) << roll_rad;
    EXPECT_LT(truth().base_in_world_m[2], 0.3) << roll_rad;
    EXPECT_NEAR(truth().base_velocity_m_s[2], 0.0, 0.02) << roll_rad;
  }
}

TEST(Plant, OnlyAFreeTrunkCanBeRolled) {
  const RobotConfig leg = load_robot("single_leg");
  const SimConfig config = load_sim_config(leg, {{"roll", 1.0}});
  EXPECT_THROW(Plant(leg, config.plant), ConfigError);
}

TEST_F(PegasusPlant, WithoutTorqueItSinksUntilSomethingElseCarriesIt) {
  make({{"friction_scale", 0.2}});
  rest(3.0);
  EXPECT_LT(truth().base_in_world_m[2], 0.3);
  EXPECT_GT(truth().base_in_world_m[2], 0.05);  // not through the floor
}

TEST_F(PegasusPlant, SlidesWhereFrictionIsTooSmallForTheSlopeAndStandsWhereItIsNot) {
  for (const double friction : {0.2, 0.6}) {
    make({{"slope", 0.3}, {"ground_friction", friction}});  // tan 0.3 = 0.31
    const double start_m = truth().base_in_world_m[0];
    hold(1.0);
    const double slid_m = start_m - truth().base_in_world_m[0];
    if (friction < 0.31) {
      EXPECT_GT(slid_m, 0.3);
    } else {
      EXPECT_LT(slid_m, 0.05);  // its joints give a little
    }
  }
}

TEST_F(PegasusPlant, StepUnderOneFootTipsTheTrunk) {
  make({{"step_from", 0.1}, {"step_width", 1.0}, {"step_height", 0.02}});  // under the front left foot alone
  hold(1.5);
  EXPECT_EQ(truth().legs[0].true_ground_height_m, 0.02);
  EXPECT_EQ(truth().legs[1].true_ground_height_m, 0.0);
  EXPECT_NEAR(ground_force_N()[2], kWeight_N, 0.5);
  EXPECT_LT(truth().base_quaternion_wxyz[2], -0.002);  // nose up
  EXPECT_GT(truth().legs[0].true_foot_in_world_m[2], 0.015);
}

TEST_F(PegasusPlant, GroundUnderOneLegMovesAlone) {
  make();
  hold(0.5);
  plant_->set_floor_height(0.01, 2);
  hold(1.0);
  EXPECT_EQ(truth().legs[2].true_ground_height_m, 0.01);
  EXPECT_GT(truth().legs[2].true_foot_in_world_m[2], truth().legs[3].true_foot_in_world_m[2] + 0.005);
  plant_->reset();
  EXPECT_EQ(truth().legs[2].true_ground_height_m, 0.0);
}

/// The rig: the trunk is held, the floor meets the feet.
TEST_F(PegasusPlant, HeldTrunkOverAFloorPushesAgainstIt) {
  make({{"suspended", 0.495}});
  hold(1.0);
  EXPECT_NEAR(truth().base_in_world_m[2], 0.495, 1e-5);
  EXPECT_GT(ground_force_N()[2], 50.0);
}

TEST_F(PegasusPlant, LegsWeighWhatRobotYamlSays) {
  make({{"suspended", 0.9}, {"friction_scale", 0.0}});
  std::vector<double> torque_Nm(12);
  for (const LegConfig& leg : robot_.legs) {
    JointVector q(3);
    for (int j = 0; j < 3; ++j)
      q[j] = plant_->position_rad(static_cast<std::size_t>(leg.joints[static_cast<std::size_t>(j)]));
    const JointVector gravity = ThreeJoint(leg).gravity_torque_Nm(q);
    for (int j = 0; j < 3; ++j) torque_Nm[leg.joints[j]] = gravity[j];
  }
  plant_->step(torque_Nm);
  for (std::size_t j = 0; j < 12; ++j)
    EXPECT_NEAR(truth().joints[j].true_acceleration_rad_s2, 0.0, 1e-6) << robot_.joints[j].name;
  EXPECT_GT(std::abs(torque_Nm[0]), 1.0);
}

TEST_F(PegasusPlant, SameBitsWhetherOrNotTheTruthIsAskedFor) {
  std::array<double, 12> end_rad{};
  for (const bool asked : {true, false}) {
    make({{"slope", 0.05}, {"step_from", 0.3}, {"step_height", 0.01}, {"ground_error", 0.02}});
    plant_->suspend(0.55);
    plant_->release();
    for (int i = 0; i < 50; ++i) {
      hold(0.01);
      if (asked) truth();
    }
    for (std::size_t j = 0; j < 12; ++j) {
      if (asked) end_rad[j] = plant_->position_rad(j);
      if (!asked) {
        EXPECT_EQ(plant_->position_rad(j), end_rad[j]);
      }
    }
  }
}

}  // namespace
}  // namespace sprung::sim
