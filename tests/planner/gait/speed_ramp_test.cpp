#include "planner/gait/speed_ramp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sprung {
namespace {

constexpr double kSpeedRampStep_s = 0.002;
constexpr std::array<double, 3> kUnlimited{1e9, 1e9, 1e9};

TEST(SpeedRampTest, GoesToTheWantedSpeedAtItsAcceleration) {
  SpeedRamp ramp;
  ramp.limit(0.2, 0.5);
  ramp.want({0.3, -0.1, 0.25});
  int cycles = 0;
  for (; !ramp.arrived() && cycles < 10000; ++cycles) {
    const auto before = ramp.now();
    ramp.advance(kSpeedRampStep_s, kUnlimited);
    EXPECT_LE(std::abs(ramp.now()[0] - before[0]), 0.2 * kSpeedRampStep_s + 1e-15);
    EXPECT_LE(std::abs(ramp.now()[1] - before[1]), 0.2 * kSpeedRampStep_s + 1e-15);
    EXPECT_LE(std::abs(ramp.now()[2] - before[2]), 0.5 * kSpeedRampStep_s + 1e-15);
  }
  EXPECT_NEAR(cycles * kSpeedRampStep_s, 1.5, 2 * kSpeedRampStep_s);
  EXPECT_EQ(ramp.now(), (std::array<double, 3>{0.3, -0.1, 0.25}));
}

TEST(SpeedRampTest, StopsInTheGivenTimeAndASlowOneAtItsAcceleration) {
  for (const double speed_m_s : {0.45, 0.3, 0.06}) {
    SpeedRamp ramp;
    ramp.limit(0.2, 0.5);
    ramp.want({speed_m_s, 0.0, 0.1});
    while (!ramp.arrived()) ramp.advance(kSpeedRampStep_s, kUnlimited);
    ramp.stop(0.6);
    int cycles = 0;
    for (; !ramp.arrived() && cycles < 10000; ++cycles) ramp.advance(kSpeedRampStep_s, kUnlimited);
    EXPECT_NEAR(cycles * kSpeedRampStep_s, std::min(0.6, speed_m_s / 0.2), 2 * kSpeedRampStep_s);
  }
}

TEST(SpeedRampTest, AfterAStopItSpeedsUpAsBefore) {
  SpeedRamp ramp;
  ramp.limit(0.2, 0.5);
  ramp.want({0.4, 0.0, 0.0});
  while (!ramp.arrived()) ramp.advance(kSpeedRampStep_s, kUnlimited);
  ramp.stop(0.1);
  while (!ramp.arrived()) ramp.advance(kSpeedRampStep_s, kUnlimited);
  ramp.want({0.4, 0.0, 0.0});
  ramp.advance(kSpeedRampStep_s, kUnlimited);
  EXPECT_NEAR(ramp.now()[0], 0.2 * kSpeedRampStep_s, 1e-12);
}

TEST(SpeedRampTest, TurnsRoundWithoutAStep) {
  SpeedRamp ramp;
  ramp.limit(1.0, 1.0);
  ramp.want({0.5, 0.0, 0.0});
  for (int k = 0; k < 100; ++k) ramp.advance(kSpeedRampStep_s, kUnlimited);
  const double before = ramp.now()[0];
  ramp.want({-0.5, 0.0, 0.0});
  ramp.advance(kSpeedRampStep_s, kUnlimited);
  EXPECT_NEAR(ramp.now()[0], before - kSpeedRampStep_s, 1e-12);
  EXPECT_FALSE(ramp.arrived());
}

TEST(SpeedRampTest, ResetItStandsAndWantsToStand) {
  SpeedRamp ramp;
  ramp.limit(1.0, 1.0);
  ramp.want({0.5, 0.5, 0.5});
  ramp.advance(kSpeedRampStep_s, kUnlimited);
  ramp.reset();
  EXPECT_TRUE(ramp.arrived());
  ramp.advance(kSpeedRampStep_s, kUnlimited);
  EXPECT_EQ(ramp.now(), (std::array<double, 3>{0.0, 0.0, 0.0}));
}

TEST(SpeedRampTest, SpeedsThatGrowTogetherShareWhatTheGaitAllows) {
  SpeedRamp ramp;
  ramp.limit(1.0, 1.0);
  ramp.want({0.3, -0.04, 0.0});
  ramp.advance(kSpeedRampStep_s, {0.2, 0.02, 0.1});
  const double forward = ramp.now()[0] / (0.2 * kSpeedRampStep_s),
               left = ramp.now()[1] / (0.02 * kSpeedRampStep_s);
  EXPECT_NEAR(forward * forward + left * left, 1.0, 1e-9);
  EXPECT_NEAR(left / forward, -2.0 / 1.5, 1e-9);  // all arrive at once
  ramp.reset();
  ramp.want({0.3, 0.0, 0.0});
  ramp.advance(kSpeedRampStep_s, {0.2, 0.02, 0.1});
  EXPECT_NEAR(ramp.now()[0], 0.2 * kSpeedRampStep_s, 1e-12);  // alone it has it all
}

TEST(SpeedRampTest, BecomesFasterNoQuickerThanTheGaitAllowsAndSlowerAtItsOwnRate) {
  SpeedRamp ramp;
  ramp.limit(0.2, 0.5);
  const std::array<double, 3> gait{0.05, 0.02, 0.1};
  ramp.want({0.1, 0.0, 0.0});
  ramp.advance(kSpeedRampStep_s, gait);
  EXPECT_NEAR(ramp.now()[0], 0.05 * kSpeedRampStep_s, 1e-15);
  while (!ramp.arrived()) ramp.advance(kSpeedRampStep_s, gait);
  ramp.want({-0.1, 0.0, 0.0});
  ramp.advance(kSpeedRampStep_s, gait);
  EXPECT_NEAR(ramp.now()[0], 0.1 - 0.2 * kSpeedRampStep_s, 1e-15);
}

}  // namespace
}  // namespace sprung
