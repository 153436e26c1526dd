#include "tools/lab/bring_up/bring_up.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"

namespace sprung {
namespace {

TEST(BringUp, WeightsLoadAJointWithAFifthOfItsTorqueAtMostAndComeInHalfKilograms) {
  for (const char* name : {"single_leg", "pegasus", "fennec", "test_axis"}) {
    const RobotConfig robot = load_robot(name);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const std::vector<BringUpPass> passes = bring_up_passes(robot, static_cast<int>(j));
      ASSERT_GE(passes.size(), 2u);
      EXPECT_EQ(passes.front().foot_weight_kg, 0.0);
      const double weight_kg = passes[1].foot_weight_kg;
      EXPECT_GT(weight_kg, 0.0) << name;
      EXPECT_DOUBLE_EQ(std::round(2.0 * weight_kg), 2.0 * weight_kg) << name;
      EXPECT_NE(passes.back().temperature_degC, passes.front().temperature_degC);
    }
  }
}

/// A gear that robot.yaml knows nothing of: what is found is the plant's, not the file's.
TEST(BringUp, FindsTheFrictionOfAPlantThatRobotYamlDoesNotKnow) {
  const RobotConfig robot = load_robot("test_axis");
  SimOptions sim;
  sim.seed = 3;
  sim.plant = {{"coulomb_scale", 1.4}, {"load_share_scale", 1.3}, {"kt_scale", 0.96}};
  BringUpProtocol protocol;
  protocol.recording = {1.0, 0.1};
  protocol.models = "viscous+load+load_gain";
  protocol.command = "a test";
  const auto changes = bring_up_joints(robot, sim, protocol, {1});
  ASSERT_EQ(changes.size(), 1u);
  const FrictionParameters& found = changes[0].joint.friction->parameters;
  const auto& plant = sim::load_sim_config(robot, sim.plant).plant.joints[0].friction;
  // Short passes; both directions are taken for alike, and here they differ by 0.05.
  EXPECT_NEAR(found.load_share_driving + found.load_share_driven,
              plant.driving_share + plant.back_driving_share, 0.15);
  EXPECT_NEAR(changes[0].torque_constant_Nm_A, 0.96 * robot.actuators[0].torque_constant_Nm_A,
              0.03 * robot.actuators[0].torque_constant_Nm_A);
  EXPECT_EQ(changes[0].joint.friction->record.command, "a test");
}

}  // namespace
}  // namespace sprung
