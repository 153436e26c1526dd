#include "estimator/tracking_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

namespace sprung {
namespace {

constexpr double kDt_s = 0.001;
constexpr double kBandwidth_rad_s = 754.0;

TEST(TrackingFilterTest, BandwidthMustFitTheCycle) {
  EXPECT_THROW((void)solve_tracking_gains(0.0, 100.0), std::invalid_argument);
  EXPECT_THROW((void)solve_tracking_gains(kDt_s, -1.0), std::invalid_argument);
  EXPECT_THROW((void)solve_tracking_gains(kDt_s, 3000.0), std::invalid_argument);
}

TEST(TrackingFilterTest, CycleThatIsTooSlowIsRefusedByKeyAndRemedy) {
  std::string said = "accepted";
  try {
    (void)solve_tracking_gains(1.0 / 250.0, kBandwidth_rad_s);
  } catch (const std::invalid_argument& error) {
    said = error.what();
  }
  EXPECT_EQ(
      said,
      "robot.yaml: key 'cycle_rate': found 250 Hz, expected more than 251.3 Hz, below which the estimator "
      "cannot follow a joint: raise it");
  EXPECT_NO_THROW((void)solve_tracking_gains(1.0 / 251.4, kBandwidth_rad_s));
}

TEST(TrackingFilterTest, GainsGoToTheContinuousFilterForShortCycles) {
  // Butterworth of third order: s^3 + 2 w s^2 + 2 w^2 s + w^3; discrete gains are dt times its coefficients.
  const double w = 10.0;
  const TrackingGains gains = solve_tracking_gains(1e-4, w);
  EXPECT_NEAR(gains.position, 1e-4 * 2.0 * w, 1e-2 * 1e-4 * 2.0 * w);
  EXPECT_NEAR(gains.velocity_1_s, 1e-4 * 2.0 * w * w, 1e-2 * 1e-4 * 2.0 * w * w);
  EXPECT_NEAR(gains.acceleration_1_s2, 1e-4 * w * w * w, 1e-2 * 1e-4 * w * w * w);
}

TEST(TrackingFilterTest, ConstantUnexplainedAccelerationIsFoundWithoutError) {
  const TrackingGains gains = solve_tracking_gains(kDt_s, kBandwidth_rad_s);
  TrackingState state;
  for (int k = 1; k <= 100; ++k) {
    const double t = k * kDt_s;
    predict(state, kDt_s, 30.0);
    correct(state, gains, 0.5 * (30.0 - 12.0) * t * t);
  }
  EXPECT_NEAR(state.unexplained_rad_s2, -12.0, 1e-6);
  EXPECT_NEAR(state.velocity_rad_s, 18.0 * 0.1, 1e-9);
}

TEST(TrackingFilterTest, KnownInputIsFollowedWithoutAnyLag) {
  const TrackingGains gains = solve_tracking_gains(kDt_s, kBandwidth_rad_s);
  TrackingState state;
  double position = 0.0, velocity = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double input = k < 100 ? 200.0 : -200.0;
    position += kDt_s * (velocity + 0.5 * kDt_s * input);
    velocity += kDt_s * input;
    predict(state, kDt_s, input);
    correct(state, gains, position);
    ASSERT_NEAR(state.velocity_rad_s, velocity, 1e-9);
    ASSERT_NEAR(state.unexplained_rad_s2, 0.0, 1e-6);
  }
}

TEST(TrackingFilterTest, NoiseStaysWithinThePromisedStd) {
  const TrackingGains gains = solve_tracking_gains(kDt_s, kBandwidth_rad_s);
  const double noise_rad = 1e-7;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, noise_rad);
  TrackingState state;
  double sum = 0.0;
  constexpr int kSamples = 20000;
  for (int k = 0; k < kSamples; ++k) {
    predict(state, kDt_s, 0.0);
    correct(state, gains, noise(random));
    sum += state.unexplained_rad_s2 * state.unexplained_rad_s2;
  }
  const double measured_std = std::sqrt(sum / kSamples);
  const double promised_std = gains.acceleration_std_1_s2 * noise_rad;
  EXPECT_LT(measured_std, promised_std);
  EXPECT_GT(measured_std, 0.3 * promised_std);  // the promise is no empty one
}

TEST(TrackingFilterTest, StableAtBothCycleRates) {
  for (double dt_s : {0.001, 0.002}) {
    const TrackingGains gains = solve_tracking_gains(dt_s, kBandwidth_rad_s);
    TrackingState state{1.0, -20.0, 500.0};
    for (int k = 0; k < 200; ++k) {
      predict(state, dt_s, 0.0);
      correct(state, gains, 0.0);
    }
    EXPECT_LT(std::abs(state.position_rad), 1e-12);
    EXPECT_LT(std::abs(state.unexplained_rad_s2), 1e-6);
  }
}

}  // namespace
}  // namespace sprung
