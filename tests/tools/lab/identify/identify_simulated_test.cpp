/// From the guided recording to a joint's numbers, against the plant that was recorded: the shipped ones, and
/// plants that differ from what robot.yaml says.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"
#include "tools/lab/identify/identify_recording.h"
#include "tools/lab/identify/leg_comparison.h"
#include "tools/lab/identify/record_in_process.h"

namespace sprung::identify {
namespace {

/// Short passes: the guided procedure's own take four times as long.
const RecordOptions kSimulatedShort{1.0, 0.1};

struct Case {
  std::string robot;
  int joint = 0;
  SimOptions sim;
};

IdentifiedJoint identified(const Case& c, const std::string& models = "viscous+stribeck",
                           const RecordOptions& options = kSimulatedShort) {
  const RobotConfig robot = load_robot(c.robot);
  ProtocolRequest protocol;
  protocol.models = models;
  return identify_drives(robot, c.joint, {{record_in_process(robot, c.sim, c.joint, options).states}},
                         protocol);
}

/// A plant whose armature and friction are somewhere within 30 % of the shipped one's.
Case drawn(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto factor = [&] { return 0.7 + 0.6 * static_cast<double>(random() >> 11) * 0x1.0p-53; };
  Case c{"single_leg", static_cast<int>(seed % 2), {}};
  c.sim.seed = seed;
  c.sim.plant = {{"armature_scale", factor()}, {"friction_scale", factor()}};
  return c;
}

sim::PlantJointConfig plant_joint(const Case& c) {
  return sim::load_sim_config(load_robot(c.robot), c.sim.plant).plant.joints[c.joint];
}

/// Friction over the speeds that were driven, against the plant's without load.
void expect_friction(const FrictionParameters& found, const sim::PlantJointConfig& plant, double tolerance,
                     double temperature_C = 24.0) {
  const auto& friction = plant.friction;
  const auto& warmth = friction.temperature;
  const double viscous = std::exp(-warmth.per_K * (temperature_C - warmth.reference_degC));
  const double dry = 1.0 + warmth.coulomb_share * (viscous - 1.0);
  for (const double speed_rad_s : {0.05, 0.3, 1.0, 2.0}) {
    const double ratio = speed_rad_s / friction.stribeck_speed_rad_s;
    const double breakaway_Nm = (friction.breakaway_Nm - friction.coulomb_Nm) * std::exp(-ratio * ratio);
    const double true_Nm = dry * (friction.coulomb_Nm + breakaway_Nm) +
                           viscous * friction.viscous_Nm_s_rad * speed_rad_s;
    FrictionInput in;
    in.velocity_rad_s = speed_rad_s;
    in.temperature_C = temperature_C;
    in.sign = 1.0;
    EXPECT_NEAR(friction_torque_Nm(found, in), true_Nm, tolerance * true_Nm) << speed_rad_s << " rad/s";
  }
}

FrictionParameters law_of(const identification::ModelResult& model) {
  return model.model->friction(model.fit.parameters);
}

TEST(IdentifySimulated, BothJointsOfTheHangingLeg) {
  for (const int joint : {0, 1}) {
    const Case c{"single_leg", joint, {}};
    const IdentifiedJoint found = identified(c);
    const sim::PlantJointConfig plant = plant_joint(c);
    ASSERT_TRUE(found.armature.has_value());
    EXPECT_NEAR(found.armature->value_kg_m2, plant.armature_kg_m2, 0.05 * plant.armature_kg_m2) << joint;
    expect_friction(law_of(found.chosen()), plant, 0.05);
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
    expect_friction(law_of(found.chosen()), plant, 0.05);
  }
}

/// The guided procedure as it ships. With accelerations fitted over 45 ms every armature is about 1.1 % high.
TEST(IdentifySimulated, ArmatureIsFoundWithinOnePercentAndWithoutBias) {
  constexpr int kPlants = 3;
  double bias = 0.0;
  for (std::uint64_t seed = 21; seed < 21 + kPlants; ++seed) {
    const Case c = drawn(seed);
    const double plant_kg_m2 = plant_joint(c).armature_kg_m2;
    const double error = identified(c, "coulomb", {}).armature.value().value_kg_m2 / plant_kg_m2 - 1.0;
    EXPECT_LT(std::abs(error), 0.01) << "seed " << seed << ", " << plant_kg_m2 << " kg m^2";
    bias += error / kPlants;
  }
  EXPECT_LT(std::abs(bias), 0.005);
}

/// One pass with and one without a weight at the foot, on a gear whose friction is viscous and of the load.
TEST(IdentifySimulated, LoadFrictionAndTorqueConstantShowWithAKnownWeight) {
  Case c{"test_axis", 0, {}};
  c.sim.plant = {{"kt_scale", 1.05}};
  const RobotConfig robot = load_robot(c.robot);
  std::vector<DriveRecording> recordings;
  for (const double weight_kg : {0.0, 8.0}) {
    RecordOptions options = kSimulatedShort;
    options.foot_weight_kg = weight_kg;
    recordings.push_back({record_in_process(robot, c.sim, 0, options).states, weight_kg});
  }
  ProtocolRequest protocol;
  protocol.models = "viscous+load+load_gain";
  const IdentifiedJoint found = identify_drives(robot, 0, recordings, protocol);
  const auto& plant = plant_joint(c).friction;
  ASSERT_TRUE(found.torque_constant && found.torque_constant->by_known_weight);
  EXPECT_NEAR(found.torque_constant->factor, 1.05, 0.03);  // the plant's shares differ by 0.036
  const double mean_share = 0.5 * (plant.driving_share + plant.back_driving_share);
  EXPECT_NEAR(weighed(found.chosen())->load_share, mean_share, 0.03);
}

/// Warmth takes two fifths of this gear's viscous friction: one law for both recordings holds at neither.
TEST(IdentifySimulated, TwoTemperaturesShowWhatWarmthDoesToFriction) {
  Case c{"single_leg", 0, {}};
  c.sim.plant = {{"family.erob_50", 1.0}, {"draw", 1.0}};
  const RobotConfig robot = load_robot(c.robot);
  std::vector<DriveRecording> recordings;
  for (const double temperature_C : {24.0, 40.0}) {
    c.sim.plant["temperature"] = temperature_C;
    recordings.push_back({record_in_process(robot, c.sim, 0, kSimulatedShort).states, 0.0, temperature_C});
  }
  ProtocolRequest protocol;
  protocol.models = "viscous+temperature";
  const FrictionParameters law = law_of(identify_drives(robot, 0, recordings, protocol).chosen());
  EXPECT_GT(law.viscous_temperature_1_K, 0.02);
  for (const double temperature_C : {24.0, 40.0}) expect_friction(law, plant_joint(c), 0.08, temperature_C);
  recordings.back().temperature_C = 26.0;  // too near to tell
  EXPECT_THROW(identify_drives(robot, 0, recordings, protocol), std::invalid_argument);
}

/// The plant has none. Without a bound samples beside a stop become 25 Nm more at 5 mrad/s; what is left of
/// them is below the slowest speed that is driven, and no speed beyond it is the worse for it.
TEST(IdentifySimulated, JointWithoutStribeckFrictionGetsNone) {
  const Case c{"single_leg", 0, {}};
  const IdentifiedJoint found = identified(c, "coulomb,viscous+stribeck");
  ASSERT_EQ(found.result.models.size(), 2u);
  EXPECT_EQ(found.chosen().model->name(), "coulomb");
  const FrictionParameters friction = law_of(found.result.models[1 - found.result.chosen]);
  EXPECT_GE(friction.stribeck_speed_rad_s, 0.03);
  EXPECT_LT(friction.stribeck_Nm, 2.0);
  expect_friction(friction, plant_joint(c), 0.05);
}

}  // namespace
}  // namespace sprung::identify
