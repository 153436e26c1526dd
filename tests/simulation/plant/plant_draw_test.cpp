#include "simulation/plant/plant_draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "simulation/plant/plant_words.h"
#include "tests/simulation/plant/sim_dump.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

using Changes = std::map<std::string, double>;
using testing::HasSubstr;

RobotConfig robot_of(const std::string& name) { return load_robot(test::source_dir() + "/robots/" + name); }

class PlantDrawTest : public testing::TestWithParam<const char*> {
 protected:
  SimConfig draw(const Changes& changes) { return load_sim_config(robot_, changes); }
  std::string dump(const Changes& changes) { return dump_of(draw(changes)); }
  RobotConfig robot_ = robot_of(GetParam());
};

TEST_P(PlantDrawTest, SameNumberIsTheSamePlantAndAnotherIsAnother) {
  EXPECT_EQ(dump({{"draw", 7}}), dump({{"draw", 7}}));
  EXPECT_NE(dump({{"draw", 7}}), dump({{"draw", 8}}));
  EXPECT_NE(dump({{"draw", 7}}), dump({{"draw", 7}, {"family.erob_100", 1}}));
  EXPECT_EQ(dump({{"draw", 0}}), dump({})) << "0 is sim.yaml's";
}

TEST_P(PlantDrawTest, EveryValueStaysInItsSpan) {
  const Variation variation = load_variation(robot_);
  for (std::uint64_t number = 1; number <= 40; ++number) {
    SimConfig config = draw({});
    for (const DrawnValue& value : draw_plant(robot_, variation, {"", number}, config)) {
      const auto span = std::find_if(
          variation.spans.begin(), variation.spans.end(),
          [&](const VariedSpan& one) { return one.quantity->key == value.quantity; });
      ASSERT_NE(span, variation.spans.end()) << value.quantity;
      ASSERT_GE(value.value, span->from) << value.quantity;
      ASSERT_LE(value.value, span->to) << value.quantity;
    }
  }
}

/// One that changed nothing would be a promise that no plant keeps.
TEST_P(PlantDrawTest, EveryQuantityMakesAnotherPlant) {
  const Variation variation = load_variation(robot_);
  SimConfig plain = draw({});
  PlantJointConfig& joint = plain.plant.joints[0];
  joint.torsion = TorsionConfig{2e4, 2e4, 0.0, 5.0, 0.0};
  joint.friction.viscous_Nm_s_rad = joint.friction.driving_share = 0.1;  // not 0, so that factors act
  for (const VariedSpan& span : variation.spans) {
    SimConfig config = plain;
    span.quantity->apply(config, 0, 0.7 * span.to + 0.3 * span.from);
    EXPECT_TRUE(dump_of(config) != dump_of(plain)) << span.quantity->key;
  }
  EXPECT_TRUE(draw({{"draw", 1}}).real_windings) << "voltage limits the torque of every drawn plant";
}

/// A second of each, from its own start.
TEST_P(PlantDrawTest, DrawnPlantsOfEveryFamilyRun) {
  for (const char* family : {"coulomb", "erob_100", "erob_50", "presliding", "stribeck"}) {
    Plant plant(robot_, draw({{"draw", 3}, {std::string(kFamilyKey) + family, 1}}).plant);
    const std::vector<double> none(robot_.joints.size(), 0.0);
    for (int i = 0; i < 4000; ++i) plant.step(none);
    EXPECT_FALSE(plant.failed()) << family << ": " << plant.failure();
    for (std::size_t i = 0; i < robot_.joints.size(); ++i)
      EXPECT_LT(std::abs(plant.velocity_rad_s(i)), 20.0) << family;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, PlantDrawTest,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

TEST(PlantDraw, FillsASpanEvenly) {
  const RobotConfig robot = robot_of("single_leg");
  const Variation variation = load_variation(robot);
  double sum = 0.0, least = 1e9, most = 0.0;
  std::set<double> different;
  constexpr int kDraws = 400;
  for (std::uint64_t number = 1; number <= kDraws; ++number) {
    SimConfig config = load_sim_config(robot, {});
    draw_plant(robot, variation, {"", number}, config);
    const double mass_kg = config.plant.bodies[0].mass_kg / 4.13;
    sum += mass_kg;
    least = std::min(least, mass_kg);
    most = std::max(most, mass_kg);
    different.insert(mass_kg);
  }
  EXPECT_EQ(different.size(), static_cast<std::size_t>(kDraws));
  EXPECT_NEAR(sum / kDraws, 1.0, 0.01);
  EXPECT_NEAR(least, 0.92, 0.003);
  EXPECT_NEAR(most, 1.08, 0.003);
}

TEST(PlantDraw, EachJointBodyAndDriveHasItsOwn) {
  const SimConfig drawn = load_sim_config(robot_of("pegasus"), {{"draw", 1}, {"family.erob_100", 1}});
  std::set<double> coulomb, mass, torque_constant;
  for (const PlantJointConfig& joint : drawn.plant.joints) coulomb.insert(joint.friction.coulomb_Nm);
  for (const PlantBodyConfig& body : drawn.plant.bodies) mass.insert(body.mass_kg);
  for (const SimDriveConfig& drive : drawn.drives) torque_constant.insert(drive.torque_constant_Nm_A);
  EXPECT_EQ(coulomb.size(), drawn.plant.joints.size());
  EXPECT_EQ(mass.size(), drawn.plant.bodies.size());
  EXPECT_EQ(torque_constant.size(), drawn.drives.size());
  EXPECT_TRUE(drawn.plant.torsion) << "its gears twist";
}

TEST(PlantDraw, FamilyAloneIsTheMiddleOfItsSpansAndNothingElseDiffers) {
  const RobotConfig robot = robot_of("single_leg");
  const SimConfig plain = load_sim_config(robot, {});
  const SimConfig drawn = load_sim_config(robot, {{"family.erob_100", 1}});
  EXPECT_NEAR(drawn.plant.joints[0].friction.coulomb_Nm, 5.2, 1e-9);
  EXPECT_NEAR(drawn.plant.joints[0].friction.viscous_Nm_s_rad, 8.0, 1e-9);
  EXPECT_EQ(drawn.plant.joints[0].friction.breakaway_Nm, drawn.plant.joints[0].friction.coulomb_Nm);
  EXPECT_EQ(drawn.plant.bodies[0].mass_kg, plain.plant.bodies[0].mass_kg);
  EXPECT_EQ(drawn.drives[0].torque_constant_Nm_A, plain.drives[0].torque_constant_Nm_A);
}

/// As a key it goes through maps of numbers, and as text again to another process.
TEST(PlantDraw, FamilyIsTypedByItsName) {
  const Changes typed = parse_plant({"draw=4", "family=erob_50"});
  EXPECT_EQ(typed, (Changes{{"draw", 4}, {"family.erob_50", 1}}));
  EXPECT_EQ(parse_plant({"draw=4", "family.erob_50=1"}), typed);
  Changes changes = parse_plant({"draw=4", "family=erob_50", "mass_scale=1.1"});
  const std::optional<PlantDraw> draw = take_draw(changes);
  ASSERT_TRUE(draw.has_value());
  EXPECT_EQ(draw->family, "erob_50");
  EXPECT_EQ(draw->number, 4U);
  EXPECT_EQ(changes, (Changes{{"mass_scale", 1.1}}));
  EXPECT_FALSE(take_draw(changes).has_value());
}

TEST(PlantDraw, FamilyTakesAllOfSimYamlsFriction) {
  const SimConfig drawn = load_sim_config(robot_of("test_axis"), {{"draw", 2}, {"family.coulomb", 1}});
  const FrictionConfig& friction = drawn.plant.joints[0].friction;
  EXPECT_EQ(friction.viscous_Nm_s_rad, 0.0);
  EXPECT_EQ(friction.driving_share, 0.0);
  EXPECT_EQ(friction.asymmetry, 0.0);
  EXPECT_EQ(friction.breakaway_Nm, friction.coulomb_Nm);
  EXPECT_GT(friction.motor_ripple.share, 0.0);
}

TEST(PlantDraw, ChangesThatAreTypedOutApplyAfterTheDraw) {
  const RobotConfig robot = robot_of("single_leg");
  const SimConfig drawn = load_sim_config(robot, {{"draw", 5}});
  const SimConfig heavy = load_sim_config(robot, {{"draw", 5}, {"mass_scale", 2.0}, {"mode_delay_us", 0}});
  EXPECT_EQ(heavy.plant.bodies[1].mass_kg, 2.0 * drawn.plant.bodies[1].mass_kg);
  EXPECT_GT(drawn.drives[0].mode_delay_s, 0.0);
  EXPECT_EQ(heavy.drives[0].mode_delay_s, 0.0);
}

TEST(PlantDraw, WhatCannotBeDrawnIsRefusedWithTheRemedy) {
  const RobotConfig robot = robot_of("single_leg");
  const auto refusal = [&](const Changes& changes) {
    return test::refusal_of<ConfigError>([&] { load_sim_config(robot, changes); });
  };
  EXPECT_THAT(refusal({{"family.wood", 1}}),
              HasSubstr("family=wood: variation.yaml has no such family; there are coulomb, erob_100"));
  EXPECT_THAT(refusal({{"draw", 1.5}}), HasSubstr("a whole number"));
  EXPECT_THAT(refusal({{"draw", -1}}), HasSubstr("a whole number"));
  EXPECT_THAT(refusal({{"family.coulomb", 1}, {"family.erob_50", 1}}), HasSubstr("found two"));
  EXPECT_THAT(refusal({{"drow", 1}}), HasSubstr("there are draw, family=NAME"));
}

TEST(PlantDraw, ImusSpansNeedAnImu) {
  const RobotConfig robot = robot_of("single_leg");
  const Variation variation = load_variation(robot_of("pegasus"));
  SimConfig config = load_sim_config(robot, {});
  EXPECT_THROW(draw_plant(robot, variation, {"", 1}, config), ConfigError);
  EXPECT_FALSE(load_sim_config(robot_of("pegasus"), {{"draw", 1}, {"imu", 0}}).imu.has_value())
      << "taken off after the draw";
}

}  // namespace
}  // namespace sprung::sim
