#include "model/friction/thermal_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprung {
namespace {

constexpr ThermalParameters kGear{0.8, 600.0, 22.0};

TEST(ThermalStateTest, StartsAtAmbient) { EXPECT_EQ(ThermalState(kGear).temperature_C(), 22.0); }

TEST(ThermalStateTest, EndsWherePowerAndCoolingBalance) {
  ThermalState state(kGear);
  for (int i = 0; i < 20000; ++i) state.step(30.0, 1.0);
  EXPECT_NEAR(state.temperature_C(), 22.0 + 0.8 * 30.0, 1e-9);
}

TEST(ThermalStateTest, IsExactForAnyStep) {
  ThermalState coarse(kGear), fine(kGear);
  coarse.step(30.0, 300.0);
  for (int i = 0; i < 300000; ++i) fine.step(30.0, 0.001);
  EXPECT_NEAR(coarse.temperature_C(), 22.0 + 24.0 * (1.0 - std::exp(-0.5)), 1e-12);
  EXPECT_NEAR(fine.temperature_C(), coarse.temperature_C(), 1e-8);
}

TEST(ThermalStateTest, CoolsToAmbientWithoutPower) {
  ThermalState state(kGear);
  state.reset(50.0);
  EXPECT_NEAR(state.step(0.0, 600.0), 22.0 + 28.0 * std::exp(-1.0), 1e-12);
}

TEST(ThermalStateTest, StaysWhereItIsWithoutParameters) {
  ThermalState state(ThermalParameters{});
  state.reset(40.0);
  EXPECT_EQ(state.step(1000.0, 10.0), 40.0);
}

TEST(ThermalStateTest, UnknownPowerIsNone) {
  ThermalState state(kGear), idle(kGear);
  state.reset(40.0);
  idle.reset(40.0);
  EXPECT_EQ(state.step(std::numeric_limits<double>::quiet_NaN(), 1.0), idle.step(0.0, 1.0));
}

}  // namespace
}  // namespace sprung
