#include "estimator/temperature_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

constexpr double kTemperatureFilterDt_s = 0.001;
const ThermalParameters kThermal{0.6, 1200.0, 24.0};

FrictionParameters law() {
  FrictionParameters p;
  p.coulomb_Nm = 4.8;
  p.viscous_Nm_s_rad = 7.4;
  p.viscous_temperature_1_K = 0.03;
  p.reference_temperature_C = 24.0;
  return p;
}

FrictionInput moving(double velocity_rad_s, double temperature_C = 24.0) {
  FrictionInput in;
  in.velocity_rad_s = velocity_rad_s;
  in.temperature_C = temperature_C;
  return in;
}

/// An arm that swings to and fro at up to 1.5 rad/s, `bias` of its weight being wrong.
TemperatureFilter swing(double true_C, double seconds, double bias_Nm, unsigned seed) {
  TemperatureFilter filter(law(), kThermal);
  filter.reset();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int k = 0; k < std::lround(seconds / kTemperatureFilterDt_s); ++k) {
    const double w = 1.5 * std::sin(2.0 * 3.14159265358979 * 0.5 * k * kTemperatureFilterDt_s);
    filter.predict(0.0, w, kTemperatureFilterDt_s);
    const double excess_Nm = friction_torque_Nm(law(), moving(w, true_C)) -
                             friction_torque_Nm(law(), moving(w, filter.temperature_C())) + bias_Nm +
                             noise(random);
    filter.observe(moving(w), excess_Nm, kTemperatureFilterDt_s);
  }
  return filter;
}

TEST(TemperatureFilterTest, WithoutThermalParametersNothingIsKnown) {
  TemperatureFilter filter(law(), {});
  filter.reset();
  filter.predict(10.0, 1.0, kTemperatureFilterDt_s);
  filter.observe(moving(1.0), -2.0, kTemperatureFilterDt_s);
  EXPECT_FALSE(filter.configured());
  EXPECT_TRUE(std::isnan(filter.temperature_C()));
}

TEST(TemperatureFilterTest, FindsTheTemperatureFromFrictionInSomeSwings) {
  for (const double true_C : {24.0, 37.0, 50.0}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const TemperatureFilter filter = swing(true_C, 8.0, 0.0, seed);
      EXPECT_NEAR(filter.temperature_C(), true_C, 3.0 * filter.std_K());
      EXPECT_LT(filter.std_K(), 2.0);
    }
  }
}

TEST(TemperatureFilterTest, StartsAsSureAsTheRoomIsKnownAndFrictionIsAsSureAsThat) {
  ThermalParameters read_off = kThermal;
  read_off.ambient_std_K = 1.5;
  TemperatureFilter sure(law(), read_off), unsure(law(), kThermal);
  for (TemperatureFilter* filter : {&sure, &unsure}) filter->reset();
  EXPECT_EQ(sure.std_K(), 1.5);
  EXPECT_EQ(unsure.std_K(), 13.0);
  const double by_kelvin_Nm = 0.03 * 7.4 * 2.0;  // at the law's reference, the viscous part alone
  EXPECT_NEAR(sure.std_Nm(moving(2.0)), 1.5 * by_kelvin_Nm, 1e-3 * by_kelvin_Nm);
  EXPECT_EQ(sure.std_Nm(moving(0.0)), 0.0);
  TemperatureFilter none(law(), {});
  none.reset();
  EXPECT_EQ(none.std_Nm(moving(2.0)), 0.0);
}

TEST(TemperatureFilterTest, AWrongWeightCancelsOverBothDirections) {
  const TemperatureFilter filter = swing(40.0, 8.0, 1.2, 4);
  EXPECT_NEAR(filter.temperature_C(), 40.0, 2.0);
}

TEST(TemperatureFilterTest, FrictionLossHeatsByTheThermalModel) {
  TemperatureFilter filter(law(), kThermal);
  filter.reset();
  for (int k = 0; k < 1200; ++k) filter.predict(20.0, 2.0, 1.0);
  EXPECT_NEAR(filter.temperature_C(), 24.0 + 0.6 * 40.0 * (1.0 - std::exp(-1.0)), 1e-6);
}

TEST(TemperatureFilterTest, AStandingJointSaysNothingAndGrowsUncertain) {
  TemperatureFilter filter = swing(40.0, 8.0, 0.0, 1);
  const double before_C = filter.temperature_C(), before_K = filter.std_K();
  for (int k = 0; k < 1000; ++k) {
    filter.predict(0.0, 0.0, kTemperatureFilterDt_s);
    filter.observe(moving(0.0), 3.0, kTemperatureFilterDt_s);
  }
  EXPECT_NEAR(filter.temperature_C(), before_C, 0.05);
  EXPECT_GT(filter.std_K(), before_K);
}

TEST(TemperatureFilterTest, APushIsNoTemperature) {
  TemperatureFilter filter = swing(40.0, 8.0, 0.0, 1);
  const double before_C = filter.temperature_C();
  for (int k = 0; k < 1000; ++k) filter.observe(moving(1.0), -12.0, kTemperatureFilterDt_s);
  EXPECT_EQ(filter.temperature_C(), before_C);
}

}  // namespace
}  // namespace sprung
