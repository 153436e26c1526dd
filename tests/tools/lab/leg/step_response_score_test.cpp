#include "tools/lab/leg/step_response_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

/// From -20 ms to 300 ms, a sample each millisecond: `start_Nm` before zero, f(t) from then on.
struct Samples {
  template <typename Function>
  Samples(double start_Nm, Function f) {
    for (int i = -20; i <= 300; ++i) {
      time_s.push_back(1e-3 * i);
      torque_Nm.push_back(i < 0 ? start_Nm : f(time_s.back()));
    }
  }
  StepFigures figures(StepEnd end) const { return step_figures(time_s, torque_Nm, end); }
  std::vector<double> time_s, torque_Nm;
};

TEST(StepResponseScoreTest, FirstOrderLagTakesTwoPointThreeTimeConstantsAndHasNoPeak) {
  const double lag_s = 0.005;
  const StepFigures s = Samples(10.0, [=](double t) {
                          return 10.0 + 40.0 * (1.0 - std::exp(-t / lag_s));
                        }).figures(StepEnd::kFinal);
  EXPECT_NEAR(s.start_Nm, 10.0, 1e-9);
  EXPECT_NEAR(s.end_Nm, 50.0, 1e-6);
  EXPECT_NEAR(s.t90_ms, 1e3 * lag_s * std::log(10.0), 0.05);
  EXPECT_TRUE(std::isnan(s.peak_ms));
}

TEST(StepResponseScoreTest, FallingOscillationPeaksAfterHalfAPeriod) {
  const double w = 2.0 * 3.14159265358979 * 36.0;
  const StepFigures s = Samples(-20.0, [=](double t) {
                          return -20.0 - 50.0 * (1.0 - std::exp(-t / 0.02) * std::cos(w * t));
                        }).figures(StepEnd::kFinal);
  EXPECT_NEAR(s.peak_ms, 0.5e3 / 36.0, 1.5);
  EXPECT_LT(s.peak_Nm, s.end_Nm);
  EXPECT_NEAR(s.end_Nm, -70.0, 0.01);
  EXPECT_GT(s.t90_ms, 0.2e3 / 36.0);
  EXPECT_LT(s.t90_ms, 0.25e3 / 36.0);
}

TEST(StepResponseScoreTest, MotionThatGoesOnIsMeasuredByItsHighestTorque) {
  const Samples samples(-9.0,
                        [](double t) { return -150.0 * std::exp(-std::pow((t - 0.006) / 0.004, 2)) - 9.0; });
  const StepFigures s = samples.figures(StepEnd::kHighest);
  EXPECT_NEAR(s.peak_ms, 6.0, 1e-9);
  EXPECT_NEAR(s.end_Nm, -159.0, 1e-9);
  EXPECT_NEAR(s.t90_ms, 6.0 - 4.0 * std::sqrt(-std::log(0.9)), 0.1);
}

TEST(StepResponseScoreTest, TorqueThatStillGrowsHasNoTimes) {
  const StepFigures s = Samples(0.0, [](double t) { return 10.0 * t; }).figures(StepEnd::kHighest);
  EXPECT_TRUE(std::isnan(s.peak_ms));
  EXPECT_TRUE(std::isnan(s.t90_ms));
}

TEST(StepResponseScoreTest, NoiseBelowTenPercentOfTheStepIsNoPeak) {
  const auto noisy = [](double share) {
    return Samples(0.0, [=](double t) { return 100.0 + (std::abs(t - 0.1) < 1e-6 ? 100.0 * share : 0.0); })
        .figures(StepEnd::kFinal)
        .peak_ms;
  };
  EXPECT_TRUE(std::isnan(noisy(0.08)));
  EXPECT_NEAR(noisy(0.12), 100.0, 1e-9);
}

TEST(StepResponseScoreTest, SamplesOnOneSideOfZeroGiveNothing) {
  EXPECT_TRUE(std::isnan(step_figures({0.0, 0.001}, {1.0, 2.0}, StepEnd::kFinal).t90_ms));
  EXPECT_TRUE(std::isnan(step_figures({-0.002, -0.001}, {1.0, 2.0}, StepEnd::kFinal).t90_ms));
  EXPECT_TRUE(std::isnan(step_figures({}, {}, StepEnd::kHighest).end_Nm));
}

}  // namespace
}  // namespace sprung
