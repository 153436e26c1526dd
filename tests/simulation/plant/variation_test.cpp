#include "simulation/plant/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

using testing::HasSubstr;

Variation read(const std::string& text) {
  RobotConfig robot;
  robot.name = "leg";
  return read_variation(YamlMap::parse("robot: leg\n" + text, "variation.yaml"), robot);
}

std::string refusal(const std::string& text) {
  return test::refusal_of<ConfigError>([&] { read(text); });
}

TEST(Variation, SpansComeInTheTablesOrderWithTheirUnits) {
  const Variation found = read(
      "bodies: {shift_x: {from: -0.01 m, to: 0.02 m}, mass_factor: {from: 0.9, to: 1.1}}\n"
      "drives: {mode_delay: {from: 1 ms, to: 10 ms}}\nfamilies: {}\n");
  ASSERT_EQ(found.spans.size(), 3U);
  EXPECT_STREQ(found.spans[0].quantity->key, "mass_factor");
  EXPECT_STREQ(found.spans[1].quantity->key, "shift_x");
  EXPECT_EQ(found.spans[1].from, -0.01);
  EXPECT_EQ(found.spans[1].to, 0.02);
  EXPECT_NEAR(found.spans[2].to, 0.01, 1e-15);
  EXPECT_FALSE(found.elastic_gears);
}

TEST(Variation, WhatItDoesNotKnowIsRefusedWithItsLine) {
  EXPECT_THAT(refusal("families: {}\nlegs: {}\n"), HasSubstr("variation.yaml:3"));
  EXPECT_THAT(refusal("families: {}\nbodies: {mass: {from: 1, to: 2}}\n"), HasSubstr("mass_factor"));
  EXPECT_THAT(refusal("families: {gears: {coulomb_factor: {from: 1, to: 2}}}\n"), HasSubstr("coulomb"));
  EXPECT_THAT(refusal("families: {}\nbodies: {mass_factor: {from: 1.1, to: 0.9}}\n"), HasSubstr("to"));
  EXPECT_THAT(refusal("families: {}\nbodies: {mass_factor: {from: 1 kg, to: 2 kg}}\n"), HasSubstr("from"));
  EXPECT_THAT(refusal("bodies: {}\n"), HasSubstr("families"));
}

TEST(Variation, ASupplyThatThereIsNotCannotDiffer) {
  const Variation found = read("plant: {supply_resistance: {from: 0.1 ohm, to: 0.2 ohm}}\nfamilies: {}\n");
  SimConfig config;
  EXPECT_THROW(found.spans[0].quantity->apply(config, 0, 0.1), ConfigError);
  config.supply = SupplyConfig{};
  found.spans[0].quantity->apply(config, 0, 0.15);
  EXPECT_EQ(config.supply->resistance_ohm, 0.15);
}

TEST(Variation, OfAnotherRobotIsRefused) {
  RobotConfig robot;
  robot.name = "other";
  EXPECT_THROW(read_variation(YamlMap::parse("robot: leg\nfamilies: {}\n", "variation.yaml"), robot),
               ConfigError);
}

TEST(Variation, WhereThereIsNoneTheRemedyIsNamed) {
  RobotConfig robot;
  robot.name = "leg";
  robot.folder = "/nowhere";
  EXPECT_THAT(test::refusal_of<ConfigError>([&] { load_variation(robot); }),
              testing::AllOf(HasSubstr("/nowhere/variation.yaml"), HasSubstr("copy it")));
}

class ShippedVariation : public testing::TestWithParam<const char*> {};

TEST_P(ShippedVariation, HasTheFamiliesAndRippleOnAll) {
  const Variation found = load_variation(load_robot(test::source_dir() + "/robots/" + GetParam()));
  EXPECT_GT(found.spans.size(), 20U);
  std::vector<std::string> names;
  for (const auto& [name, spans] : found.families) {
    names.push_back(name);
    EXPECT_TRUE(std::any_of(spans.begin(), spans.end(), [](const VariedSpan& span) {
      return span.quantity->key == std::string("ripple_share");
    })) << name;
  }
  EXPECT_THAT(names, testing::ElementsAre("coulomb", "erob_100", "erob_50", "presliding", "stribeck"));
}

/// What the stack believes lies inside, so that a drawn plant is this robot's and not another's.
TEST_P(ShippedVariation, FactorsHaveOneInside) {
  for (const VariedSpan& span :
       load_variation(load_robot(test::source_dir() + "/robots/" + GetParam())).spans) {
    if (std::string(span.quantity->key).find("_factor") == std::string::npos) continue;
    EXPECT_LT(span.from, 1.0) << span.quantity->key;
    EXPECT_GT(span.to, 1.0) << span.quantity->key;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ShippedVariation,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

}  // namespace
}  // namespace sprung::sim
