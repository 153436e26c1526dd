#include "simulation/hash_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

TEST(HashNoise, HasMeanZeroAndRmsOne) {
  double sum = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  constexpr int kSamples = 100000;
  for (int cycle = 0; cycle < kSamples; ++cycle) {
    const double value = hash_noise(1, 0, cycle);
    sum += value;
    square += value * value;
    fourth += value * value * value * value;
    ASSERT_LT(std::abs(value), 3.4642);
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 0.01);
  EXPECT_NEAR(square / kSamples, 1.0, 0.01);
  EXPECT_NEAR(fourth / kSamples, 2.7, 0.05);  // 3 - 6/5/4 for four uniforms
}

TEST(HashNoise, SeedsSignalsAndCyclesAreUncorrelated) {
  double seeds = 0.0;
  double signals = 0.0;
  double cycles = 0.0;
  constexpr int kSamples = 20000;
  for (int cycle = 0; cycle < kSamples; ++cycle) {
    const double value = hash_noise(1, 0, cycle);
    seeds += value * hash_noise(2, 0, cycle);
    signals += value * hash_noise(1, 1, cycle);
    cycles += value * hash_noise(1, 0, cycle + 1);
  }
  EXPECT_NEAR(seeds / kSamples, 0.0, 0.03);
  EXPECT_NEAR(signals / kSamples, 0.0, 0.03);
  EXPECT_NEAR(cycles / kSamples, 0.0, 0.03);
}

TEST(HashNoise, IsAFunctionOfItsArgumentsAlone) {
  const double value = hash_noise(7, 3, 1000);
  hash_noise(1, 1, 1);
  EXPECT_EQ(hash_noise(7, 3, 1000), value);
  EXPECT_NE(hash_noise(7, 3, -1), value);
}

}  // namespace
}  // namespace sprung::sim
