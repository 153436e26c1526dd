/// From the guided recording to a joint's numbers, against the plant that was recorded: the shipped ones, and plants that
/// differ from what robot.yaml says.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drivers/sim/sim_config.h"
#include "robots/robot_loader.h"
#include "tools/identify/identify_recording.h"
#include "tools/identify/record_in_process.h"

namespace sprung::identify {
namespace {

/// Short passes: the guided procedure's own take four times as long.
const RecordOptions kShort{1.0, 0.1};

struct Case {
  std::string robot;
  int joint = 0;
  SimOptions sim;
};

IdentifiedJoint identified(const Case& c) {
  const RobotConfig robot = load_robot(c.robot);
  ProtocolRequest protocol;
  protocol.models = "viscous+stribeck";
  return identify_drives(robot, c.joint, record_in_process(robot, c.sim, c.joint, kShort).states, protocol);
}

const sim::PlantJointConfig plant_joint(const Case& c) {
  return sim::load_sim_config(load_robot(c.robot), c.sim.plant)
      .plant.joints[static_cast<std::size_t>(c.joint)];
}

/// Friction over the speeds that were driven, against the plant's without load.
void expect_friction(const IdentifiedJoint& joint, const sim::PlantJointConfig& plant, double tolerance) {
  const FrictionParameters found = joint.chosen().model->friction(joint.chosen().fit.parameters);
  const auto& friction = plant.friction;
  for (const double speed_rad_s : {0.05, 0.3, 1.0, 2.0}) {
    const double ratio = speed_rad_s / friction.stribeck_speed_rad_s;
    const double true_Nm = friction.coulomb_Nm +
                           (friction.breakaway_Nm - friction.coulomb_Nm) * std::exp(-ratio * ratio) +
                           friction.viscous_Nm_s_rad * speed_rad_s;
    FrictionInput in;
    in.velocity_rad_s = speed_rad_s;
    in.sign = 1.0;
    EXPECT_NEAR(friction_torque_Nm(found, in), true_Nm, tolerance * true_Nm) << speed_rad_s << " rad/s";
  }
}

TEST(IdentifySimulated, BothJointsOfTheHangingLeg) {
  for (const int joint : {0, 1}) {
    const Case c{"single_leg", joint, {}};
    const IdentifiedJoint found = identified(c);
    const sim::PlantJointConfig plant = plant_joint(c);
    ASSERT_TRUE(found.armature.has_value());
    EXPECT_NEAR(found.armature->value_kg_m2, plant.armature_kg_m2, 0.05 * plant.armature_kg_m2) << joint;
    expect_friction(found, plant, 0.05);
    EXPECT_GT(found.chosen().held_out.r2, 0.97) << joint;
  }
}

TEST(IdentifySimulated, PlantThatIsNotWhatTheRobotFileSays) {
  int seed = 1;
  for (const auto& [armature, friction] : {std::pair{1.3, 0.6}, std::pair{0.75, 1.4}}) {
    Case c{"single_leg", 1, {}};
    c.sim.seed = static_cast<std::uint64_t>(++seed);
    c.sim.plant = {{"armature_scale", armature}, {"friction_scale", friction}};
    const IdentifiedJoint found = identified(c);
    const sim::PlantJointConfig plant = plant_joint(c);
    ASSERT_TRUE(found.armature.has_value());
    EXPECT_NEAR(found.armature->value_kg_m2, plant.armature_kg_m2, 0.05 * plant.armature_kg_m2);
    expect_friction(found, plant, 0.05);
  }
}

}  // namespace
}  // namespace sprung::identify
