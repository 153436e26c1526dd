#include "planner/jump_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class JumpCurveTest : public testing::Test {
 protected:
  RobotConfig robot_ = load_robot("single_leg");
  PresetConfig preset_ = robot_.preset("paper");
};

TEST_F(JumpCurveTest, ScaleGoesWithTheRootOfTheHeight) {
  const JumpCurveConfig& curve = preset_.jump_curve;
  EXPECT_EQ(jump_scale(curve, 0.0), 1.0);
  EXPECT_EQ(jump_scale(curve, curve.height_m), 1.0);
  EXPECT_NEAR(jump_scale(curve, curve.height_m / 4.0), 0.5, 1e-15);
  EXPECT_TRUE(std::isnan(jump_scale(curve, 0.019)));
  EXPECT_TRUE(std::isnan(jump_scale(curve, kHighestJump * curve.height_m + 0.001)));
  EXPECT_TRUE(std::isnan(jump_scale(curve, -0.1)));
  EXPECT_TRUE(std::isnan(jump_scale(curve, std::nan(""))));
}

TEST_F(JumpCurveTest, AtScaleOneItIsTheFilesOwnCurve) {
  JumpCurve curve(preset_);
  const Bezier own(preset_.jump_curve.lengths_m, preset_.jump_curve.duration_s);
  for (double t = 0.0; t <= 0.2; t += 0.01) {
    EXPECT_NEAR(curve.at(t).position_m[2], -own.at(t).value, 1e-15);
    EXPECT_NEAR(curve.at(t).velocity_m_s[2], -own.at(t).rate_1_s, 1e-12);
    EXPECT_EQ(curve.at(t).position_m[0], 0.0);
  }
}

TEST_F(JumpCurveTest, EveryScaleBeginsAtTheCrouchAndEndsAtTheLandingLength) {
  JumpCurve curve(preset_);
  for (double height : {0.02, 0.1, 0.22}) {
    curve.scale(jump_scale(preset_.jump_curve, height));
    EXPECT_NEAR(curve.at(0.0).position_m[2], -0.35, 1e-12);
    EXPECT_NEAR(curve.at(0.2).position_m[2], -0.478, 1e-12);
    EXPECT_NEAR(curve.at(1.0).position_m[2], -0.478, 1e-12);
  }
}

TEST_F(JumpCurveTest, EveryAllowedJumpIsWithinTheLegsReach) {
  const double reach = robot_.legs[0].links[0].length_m + robot_.legs[0].links[1].length_m;
  for (const PresetConfig& preset : robot_.presets) {
    JumpCurve curve(preset);
    curve.scale(jump_scale(preset.jump_curve, kHighestJump * preset.jump_curve.height_m));
    for (double t = 0.0; t <= 0.2; t += 0.001) EXPECT_LT(-curve.at(t).position_m[2], 0.98 * reach);
  }
}

TEST_F(JumpCurveTest, LongestLegIsTheTopOfTheScaledCurve) {
  JumpCurve curve(preset_);
  for (double factor : {0.4, 1.0}) {
    curve.scale(factor);
    double top_m = 0.0;
    for (double t = 0.0; t <= 0.2; t += 1e-5) top_m = std::max(top_m, -curve.at(t).position_m[2]);
    EXPECT_NEAR(curve.longest_m(), top_m, 1e-5);
  }
}

TEST_F(JumpCurveTest, HigherJumpsExtendFaster) {
  JumpCurve low(preset_), high(preset_);
  low.scale(jump_scale(preset_.jump_curve, 0.05));
  high.scale(jump_scale(preset_.jump_curve, 0.2));
  EXPECT_LT(high.at(0.08).velocity_m_s[2], low.at(0.08).velocity_m_s[2]);
}

TEST_F(JumpCurveTest, CurveMustEndAtTheLandingLength) {
  preset_.landing_length_m = 0.5;
  EXPECT_THROW(JumpCurve{preset_}, std::invalid_argument);
  preset_.jump_curve.lengths_m.clear();
  EXPECT_THROW(JumpCurve{preset_}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
