#include "estimator/tracking_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

constexpr double kTrackingFilterDt_s = 0.001;
constexpr double kDensity = 5000.0;  // of a joint of 0.8 kg m^2
constexpr double kStd_rad = 1.4e-7;  // of a 17-bit encoder behind 100:1

TrackingFilter settled(double std_rad = kStd_rad, double dt_s = kTrackingFilterDt_s) {
  TrackingFilter filter(kDensity);
  filter.start(0.0, 0.0, std_rad, 10.0);
  for (int k = 0; k < 300; ++k) {
    filter.predict(dt_s, 0.0);
    filter.correct(0.0, std_rad);
  }
  return filter;
}

TEST(TrackingFilterTest, ConstantUnexplainedAccelerationIsFoundWithoutError) {
  TrackingFilter filter = settled();
  for (int k = 1; k <= 100; ++k) {
    const double t = k * kTrackingFilterDt_s;
    filter.predict(kTrackingFilterDt_s, 30.0);
    filter.correct(0.5 * (30.0 - 12.0) * t * t, kStd_rad);
  }
  EXPECT_NEAR(filter.unexplained_rad_s2(), -12.0, 1e-6);
  EXPECT_NEAR(filter.velocity_rad_s(), 18.0 * 0.1, 1e-9);
}

TEST(TrackingFilterTest, KnownInputIsFollowedWithoutAnyLag) {
  TrackingFilter filter = settled();
  double position = 0.0, velocity = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double input = k < 100 ? 200.0 : -200.0;
    position += kTrackingFilterDt_s * (velocity + 0.5 * kTrackingFilterDt_s * input);
    velocity += kTrackingFilterDt_s * input;
    filter.predict(kTrackingFilterDt_s, input);
    filter.correct(position, kStd_rad);
    ASSERT_NEAR(filter.velocity_rad_s(), velocity, 1e-9);
    ASSERT_NEAR(filter.unexplained_rad_s2(), 0.0, 1e-6);
  }
}

/// In steady state the third pole's circle has radius (density / (variance dt))^(1/6), Butterworth: error of
/// a ramp of the unexplained acceleration is 2 / radius times its rate.
TEST(TrackingFilterTest, SteadyStateIsTheButterworthFilterOfItsNoises) {
  constexpr double kRate_rad_s3 = 100.0, kFine_s = 1e-4, kNoisy_rad = 0.05;
  const double radius = std::pow(kDensity / (kNoisy_rad * kNoisy_rad * kFine_s), 1.0 / 6.0);
  TrackingFilter filter = settled(kNoisy_rad, kFine_s);
  double t = 0.0;
  for (int k = 0; k < 20000; ++k) {
    t += kFine_s;
    filter.predict(kFine_s, 0.0);
    filter.correct(kRate_rad_s3 * t * t * t / 6.0, kNoisy_rad);
  }
  const double lag = kRate_rad_s3 * t - filter.unexplained_rad_s2();
  EXPECT_NEAR(lag, kRate_rad_s3 * 2.0 / radius, 0.02 * lag);
}

TEST(TrackingFilterTest, ErrorsOfItsOwnModelHaveTheStandardDeviationsThatItStates) {
  for (const double dt_s : {0.001, 0.002}) {
    for (const double std_rad : {kStd_rad, 100.0 * kStd_rad}) {
      TrackingFilter filter = settled(std_rad, dt_s);
      std::mt19937 random(7);
      std::normal_distribution<double> normal(0.0, 1.0);
      double q = 0.0, w = 0.0, u = 0.0, squares = 0.0, velocity_squares = 0.0;
      constexpr int kSamples = 20000;
      for (int k = 0; k < kSamples; ++k) {
        constexpr int kFine = 10;
        for (int i = 0; i < kFine; ++i) {
          const double h = dt_s / kFine;
          q += h * w + 0.5 * h * h * u;
          w += h * u;
          u += std::sqrt(kDensity * h) * normal(random);
        }
        filter.predict(dt_s, 0.0);
        filter.correct(q + std_rad * normal(random), std_rad);
        squares += std::pow((filter.unexplained_rad_s2() - u) / filter.unexplained_std_rad_s2(), 2);
        velocity_squares += std::pow((filter.velocity_rad_s() - w) / filter.velocity_std_rad_s(), 2);
      }
      EXPECT_NEAR(std::sqrt(squares / kSamples), 1.0, 0.05);
      EXPECT_NEAR(std::sqrt(velocity_squares / kSamples), 1.0, 0.05);
    }
  }
}

TEST(TrackingFilterTest, AnUncertainEncoderMakesItPatient) {
  TrackingFilter quick = settled(kStd_rad), patient = settled(100.0 * kStd_rad);
  for (TrackingFilter* filter : {&quick, &patient}) {
    filter->predict(kTrackingFilterDt_s, 0.0);
    filter->correct(5e-6, filter == &quick ? kStd_rad : 100.0 * kStd_rad);
  }
  EXPECT_GT(quick.unexplained_step_rad_s2(), 5.0 * patient.unexplained_step_rad_s2());
  EXPECT_LT(quick.unexplained_std_rad_s2(), patient.unexplained_std_rad_s2());
}

TEST(TrackingFilterTest, CoastingIsLessCertainWithEveryCycle) {
  TrackingFilter filter = settled();
  double before = filter.unexplained_std_rad_s2();
  for (int k = 0; k < 5; ++k) {
    filter.predict(kTrackingFilterDt_s, 0.0);
    EXPECT_GT(filter.unexplained_std_rad_s2(), before);
    before = filter.unexplained_std_rad_s2();
  }
}

TEST(TrackingFilterTest, AWrongStartIsForgottenAtBothCycleRates) {
  for (const double dt_s : {0.001, 0.002}) {
    TrackingFilter filter(kDensity);
    filter.start(1.0, 500.0, 1.0, 500.0);
    for (int k = 0; k < 200; ++k) {
      filter.predict(dt_s, 0.0);
      filter.correct(0.0, kStd_rad);
    }
    EXPECT_LT(std::abs(filter.position_rad()), 1e-12);
    EXPECT_LT(std::abs(filter.unexplained_rad_s2()), 1e-6);
  }
}

}  // namespace
}  // namespace sprung
