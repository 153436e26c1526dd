#include "tools/lab/tune/tune_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/preset_section.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TuneParameter, IsReadFromTheCommandLine) {
  const TuneParameter parameter = parse_vary("hybrid_landing.stiffness.z=400:3000");
  EXPECT_EQ(parameter.key, "hybrid_landing.stiffness.z");
  EXPECT_EQ(parameter.low, 400.0);
  EXPECT_EQ(parameter.high, 3000.0);
  EXPECT_EQ(parse_vary("a=-1.5:-1e-1").low, -1.5);
  for (const char* wrong : {"a", "a=1", "=1:2", "a=1:x", "a=1:2 N/m", "a=2:1", "a=1:1", "a=0:inf", "a=:2"})
    EXPECT_THROW(parse_vary(wrong), std::invalid_argument) << wrong;
}

TEST(TuneParameter, WideRangesAboveZeroCountInRatios) {
  const TuneParameter wide{"k", 100, 10000}, narrow{"k", 100, 300}, from_zero{"k", 0, 10};
  EXPECT_DOUBLE_EQ(wide.at(0.5), 1000.0);
  EXPECT_DOUBLE_EQ(narrow.at(0.5), 200.0);
  EXPECT_DOUBLE_EQ(from_zero.at(0.5), 5.0);
  for (const TuneParameter& parameter : {wide, narrow, from_zero}) {
    EXPECT_EQ(parameter.at(0.0), parameter.low);
    EXPECT_EQ(parameter.at(1.0), parameter.high);
    EXPECT_NEAR(parameter.share_of(parameter.at(0.3)), 0.3, 1e-3);
  }
  EXPECT_EQ(wide.share_of(1.0), 0.0);
}

TEST(TuneParameter, HasFourDigitsAsItWillStandInTheFile) {
  EXPECT_DOUBLE_EQ((TuneParameter{"k", 1.0, 3.0}.at(1.0 / 3.0)), 1.667);
}

class TuneSpaceTest : public testing::Test {
 protected:
  RobotConfig robot_ = load_robot("single_leg");
  TuneSpace space_{robot_,
                   "best",
                   {{"hybrid_landing.stiffness.z", 400, 3000},
                    {"hybrid_landing.damping.z", 5, 120},
                    {"jump_curve.lengths.4", 0.55, 0.66}}};
};

TEST_F(TuneSpaceTest, ThePresentValuesAreThoseOfThePreset) {
  const PresetConfig& preset = robot_.preset("best");
  EXPECT_THAT(space_.present(),
              ElementsAre(preset.hybrid_landing.stiffness_N_m[2], preset.hybrid_landing.damping_N_s_m[2],
                          preset.jump_curve.lengths_m[4]));
  EXPECT_EQ(space_.unit(0), "N/m");
  EXPECT_EQ(space_.unit(2), "m");
}

TEST_F(TuneSpaceTest, ARobotWithOtherValuesDiffersInThemAlone) {
  const RobotConfig changed = space_.with({777.0, 33.0, 0.61});
  const PresetConfig& preset = changed.preset("best");
  EXPECT_EQ(preset.hybrid_landing.stiffness_N_m[2], 777.0);
  EXPECT_EQ(preset.hybrid_landing.damping_N_s_m[2], 33.0);
  EXPECT_EQ(preset.jump_curve.lengths_m[4], 0.61);
  EXPECT_EQ(preset.hybrid_landing.stiffness_N_m[0], robot_.preset("best").hybrid_landing.stiffness_N_m[0]);
  EXPECT_EQ(preset.jump_curve.lengths_m[3], robot_.preset("best").jump_curve.lengths_m[3]);
  EXPECT_EQ(changed.preset("paper").hybrid_landing.stiffness_N_m[2],
            robot_.preset("paper").hybrid_landing.stiffness_N_m[2]);
  EXPECT_EQ(space_.present()[0], robot_.preset("best").hybrid_landing.stiffness_N_m[2]) << "space changed";
}

TEST_F(TuneSpaceTest, TheFragmentHoldsTheKeysNestedWithUnits) {
  EXPECT_EQ(space_.fragment({777.0, 33.5, 0.61}, "why"),
            "# why\n"
            "presets:\n"
            "  best:\n"
            "    hybrid_landing:\n"
            "      stiffness:\n"
            "        z: 777 N/m\n"
            "      damping:\n"
            "        z: 33.5 N s/m\n"
            "    jump_curve:\n"
            "      lengths:\n"
            "        4: 0.61 m\n");
}

TEST_F(TuneSpaceTest, WhatThePresetDoesNotHaveIsRefused) {
  EXPECT_THROW(TuneSpace(robot_, "best", {{"hybrid_landing.stiffness.w", 1, 2}}), ConfigError);
  EXPECT_THROW(TuneSpace(robot_, "best", {{"compensated_friction", 1, 2}}), ConfigError);
  EXPECT_THROW(TuneSpace(robot_, "best", {}), std::invalid_argument);
  EXPECT_THROW(TuneSpace(robot_, "best", {{"rise_time", 1, 2}, {"rise_time", 1, 3}}), std::invalid_argument);
  EXPECT_THROW(TuneSpace(robot_, "fast", {{"rise_time", 1, 2}}), std::invalid_argument);
}

TEST_F(TuneSpaceTest, ValuesThatRobotYamlMayNotHoldAreRefused) {
  EXPECT_THROW(space_.with({-1.0, 30.0, 0.6}), ConfigError);
}

}  // namespace
}  // namespace sprung
