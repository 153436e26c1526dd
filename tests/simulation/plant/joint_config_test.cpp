#include "simulation/plant/joint_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

using testing::HasSubstr;

std::string text(const std::string& friction, const std::string& more = "") {
  return "name: knee\ninitial: 0.5 rad\narmature: 0.8 kg m^2\nstops: {min: 0 rad, max: 2 rad}\n"
         "friction: {coulomb: 4 Nm, breakaway: 5 Nm, stribeck_speed: 0.1 rad/s, viscous: 7 Nm s/rad, " +
         friction + "}\n" + more;
}

PlantJointConfig joint(const std::string& friction, const std::string& more = "") {
  return read_plant_joint(YamlMap::parse(text(friction, more), "sim.yaml"));
}

std::string refusal(const std::string& friction, const std::string& more = "") {
  return test::refusal_of<ConfigError>([&] { joint(friction, more); });
}

TEST(PlantJoint, OneLoadShareIsBoth) {
  const FrictionConfig friction = joint("load_share: 0.1").friction;
  EXPECT_EQ(friction.driving_share, 0.1);
  EXPECT_EQ(friction.back_driving_share, 0.1);
  EXPECT_EQ(friction.asymmetry, 0.0);
  EXPECT_EQ(friction.temperature.per_K, 0.0);
}

TEST(PlantJoint, LoadSharesOfBothDirectionsComeTogetherAndAlone) {
  const FrictionConfig friction = joint("driving_share: 0.1, back_driving_share: 0.2").friction;
  EXPECT_EQ(friction.driving_share, 0.1);
  EXPECT_EQ(friction.back_driving_share, 0.2);
  EXPECT_THAT(refusal("driving_share: 0.1"), HasSubstr("back_driving_share' is missing"));
  EXPECT_THAT(refusal("load_share: 0.1, driving_share: 0.1, back_driving_share: 0.2"),
              HasSubstr("load_share"));
  EXPECT_THAT(refusal("asymmetry: 0.1"), HasSubstr("load_share' is missing"));
}

TEST(PlantJoint, OptionalPartsAreAbsentWhereNotGiven) {
  const PlantJointConfig plain = joint("load_share: 0");
  EXPECT_FALSE(plain.torsion.has_value());
  EXPECT_EQ(plain.thermal.resistance_K_W, 0.0);
}

TEST(PlantJoint, RipplePreslidingAndBacklashAreNoneUnlessGiven) {
  const PlantJointConfig plain = joint("load_share: 0",
                                       "torsion: {stiffness: 25000 Nm/rad, damping: 5 Nm s/rad}");
  EXPECT_EQ(plain.friction.motor_ripple.share, 0.0);
  EXPECT_EQ(plain.friction.presliding_rad, 0.0);
  EXPECT_EQ(plain.torsion->backlash_rad, 0.0);
  const PlantJointConfig full = joint(
      "load_share: 0, presliding: 0.0003 rad, ripple: {share: 0.05, phase: 1 rad}, "
      "joint_ripple: {share: 0.1, order: 1}",
      "torsion: {stiffness: 25000 Nm/rad, damping: 5 Nm s/rad, backlash: 0.00029 rad}");
  EXPECT_EQ(full.friction.presliding_rad, 0.0003);
  EXPECT_EQ(full.friction.motor_ripple.share, 0.05);
  EXPECT_EQ(full.friction.motor_ripple.order, 2.0);
  EXPECT_EQ(full.friction.motor_ripple.phase_rad, 1.0);
  EXPECT_EQ(full.friction.joint_ripple.share, 0.1);
  EXPECT_EQ(full.friction.joint_ripple.order, 1.0);
  EXPECT_EQ(full.torsion->backlash_rad, 0.00029);
  EXPECT_THAT(refusal("load_share: 0, presliding: 1 rad"), HasSubstr("presliding"));
  EXPECT_THAT(refusal("load_share: 0, ripple: {share: 2}"), HasSubstr("share"));
}

TEST(PlantJoint, EveryPartIsRead) {
  const PlantJointConfig full = joint(
      "load_share: 0, asymmetry: 0.05, temperature: {coefficient: 0.03 1/K, reference: 20 degC, "
      "coulomb_share: 0.2}",
      "thermal: {resistance: 0.6 K/W, time_constant: 1200 s}\n"
      "torsion: {stiffness: 25000 Nm/rad, second_stiffness: 34000 Nm/rad, second_from: 14 Nm, damping: 5 Nm "
      "s/rad}\n");
  EXPECT_EQ(full.friction.asymmetry, 0.05);
  EXPECT_EQ(full.friction.temperature.per_K, 0.03);
  EXPECT_EQ(full.friction.temperature.reference_degC, 20.0);
  EXPECT_EQ(full.friction.temperature.coulomb_share, 0.2);
  EXPECT_EQ(full.thermal.resistance_K_W, 0.6);
  EXPECT_EQ(full.thermal.time_constant_s, 1200.0);
  ASSERT_TRUE(full.torsion.has_value());
  EXPECT_EQ(full.torsion->second_stiffness_Nm_rad, 34000.0);
  EXPECT_EQ(full.torsion->second_from_Nm, 14.0);
  EXPECT_EQ(full.torsion->damping_Nm_s_rad, 5.0);
}

TEST(PlantJoint, OneStiffnessHoldsEverywhere) {
  const PlantJointConfig plain = joint("load_share: 0",
                                       "torsion: {stiffness: 9000 Nm/rad, damping: 0 Nm s/rad}\n");
  EXPECT_EQ(plain.torsion.value().second_stiffness_Nm_rad, 9000.0);
}

TEST(PlantJoint, UnknownKeysAndImpossibleValuesAreRefused) {
  EXPECT_THAT(refusal("load_share: 0, rust: 1"), HasSubstr("rust"));
  EXPECT_THAT(refusal("load_share: 0", "torsion: {stiffness: 9000 Nm/rad, damping: 0 Nm s/rad, play: 1}\n"),
              HasSubstr("play"));
  EXPECT_THAT(refusal("load_share: 0", "thermal: {resistance: 1 K/W, time_constant: 0 s}\n"),
              HasSubstr("time_constant"));
  EXPECT_THAT(refusal("load_share: 0, temperature: {coefficient: 0.03 1/K}"), HasSubstr("reference"));
  EXPECT_THAT(refusal("load_share: 0, asymmetry: 1"), HasSubstr("asymmetry"));
}

}  // namespace
}  // namespace sprung::sim
