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
  for (double factor : {0.4, 1.0, 1.4}) {
    curve.scale(factor);
    EXPECT_NEAR(curve.at(0.0).position_m[2], -preset_.jump_curve.lengths_m.front(), 1e-12);
    EXPECT_NEAR(curve.at(0.2).position_m[2], -preset_.landing_length_m, 1e-12);
    EXPECT_NEAR(curve.at(1.0).position_m[2], -preset_.landing_length_m, 1e-12);
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
  low.scale(0.5);
  high.scale(1.0);
  EXPECT_LT(high.at(0.08).velocity_m_s[2], low.at(0.08).velocity_m_s[2]);
}

TEST_F(JumpCurveTest, WayForwardLeavesTheHeightAlone) {
  JumpCurve here(preset_), ahead(preset_);
  ahead.forward(0.04, 0.4);
  for (double t = 0.0; t <= 0.3; t += 0.01) {
    EXPECT_EQ(ahead.at(t).position_m[2], here.at(t).position_m[2]);
    EXPECT_EQ(ahead.at(t).velocity_m_s[2], here.at(t).velocity_m_s[2]);
  }
}

TEST_F(JumpCurveTest, FootPushesTheHipForwardAndLandsAhead) {
  JumpCurve curve(preset_);
  curve.forward(0.04, 0.4);
  EXPECT_EQ(curve.at(0.0).position_m[0], 0.0);
  EXPECT_EQ(curve.at(0.0).velocity_m_s[0], 0.0);
  EXPECT_NEAR(curve.at(0.1).velocity_m_s[0], -0.9 * 0.04 / 0.4, 1e-9);
  EXPECT_NEAR(curve.at(0.2).position_m[0], kForwardAhead * 0.04, 1e-12);
  EXPECT_NEAR(curve.at(0.2).velocity_m_s[0], 0.0, 1e-12);
  curve.forward(0.0, 0.4);
  EXPECT_EQ(curve.at(0.1).position_m[0], 0.0);
}

TEST_F(JumpCurveTest, WayForwardIsSmooth) {
  JumpCurve curve(preset_);
  curve.forward(-0.1, 0.35);
  constexpr double kStep_s = 1e-6;
  for (double t = 0.01; t < 0.2; t += 0.01) {
    const double slope = (curve.at(t + kStep_s).position_m[0] - curve.at(t - kStep_s).position_m[0]) /
                         (2 * kStep_s);
    EXPECT_NEAR(curve.at(t).velocity_m_s[0], slope, 1e-6);
  }
}

TEST_F(JumpCurveTest, CurveMustEndAtTheLandingLength) {
  preset_.landing_length_m = 0.5;
  EXPECT_THROW(JumpCurve{preset_}, std::invalid_argument);
  preset_.jump_curve.lengths_m.clear();
  EXPECT_THROW(JumpCurve{preset_}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
