#include "tools/can/commission/current_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::commission {
namespace {

constexpr double kTarget_A = 0.8;

/// Scatter that is the same every time.
double noise(int i, double size_A) { return size_A * std::sin(12.9898 * i * i + 0.7); }

template <class Shape>
CurrentStepResult judged(Shape shape, double noise_A = 0.0, double target_A = kTarget_A) {
  std::vector<CurrentSample> before, after;
  for (int i = 0; i < 100; ++i) before.push_back({0.0005 * i, noise(i, noise_A)});
  for (int i = 0; i < 120; ++i)
    after.push_back({0.0005 * i, target_A * shape(0.0005 * i) + noise(i + 500, noise_A)});
  return judge_current_step(before, after, target_A);
}

auto lag(double bandwidth_Hz) {
  return [=](double t_s) { return 1.0 - std::exp(-2.0 * 3.14159265 * bandwidth_Hz * t_s); };
}

TEST(CurrentStep, LoopsOfUsualBandwidthFollowWithNoiseToo) {
  for (const double bandwidth_Hz : {94.0, 146.0, 1000.0}) {
    EXPECT_EQ(judged(lag(bandwidth_Hz)).verdict, CurrentLoopVerdict::kFollows) << bandwidth_Hz;
    EXPECT_EQ(judged(lag(bandwidth_Hz), 0.2).verdict, CurrentLoopVerdict::kFollows) << bandwidth_Hz;
    EXPECT_EQ(judged(lag(bandwidth_Hz), 0.0, -kTarget_A).verdict, CurrentLoopVerdict::kFollows);
  }
}

TEST(CurrentStep, ALoopOfAnotherMotorIsSluggishOrOscillates) {
  EXPECT_EQ(judged(lag(20.0)).verdict, CurrentLoopVerdict::kSluggish);
  EXPECT_EQ(judged([](double t_s) { return 1.0 + 0.5 * std::sin(2000.0 * t_s); }).verdict,
            CurrentLoopVerdict::kOscillates);
}

TEST(CurrentStep, AnOpenCableAndAnotherScaleAreNamed) {
  EXPECT_EQ(judged([](double) { return 0.0; }).verdict, CurrentLoopVerdict::kNothing);
  EXPECT_EQ(judged([](double) { return 1.4; }).verdict, CurrentLoopVerdict::kElsewhere);
  EXPECT_EQ(judge_current_step({}, {}, kTarget_A).verdict, CurrentLoopVerdict::kNothing);
}

}  // namespace
}  // namespace sprung::commission
