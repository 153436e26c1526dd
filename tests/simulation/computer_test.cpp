#include "simulation/computer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sprung::sim {
namespace {

constexpr int kCycles = 100000;

TimingConfig timing(double tail_s, double missed) {
  TimingConfig out;
  out.compute_s = 300e-6;
  out.compute_tail_s = tail_s;
  out.missed_cycles = missed;
  return out;
}

TEST(Computer, IsAlwaysInTimeUnlessToldOtherwise) {
  const Computer computer(timing(0.0, 0.0), 1);
  EXPECT_FALSE(computer.may_be_late(0));
  for (int cycle = 0; cycle < 1000; ++cycle) {
    ASSERT_EQ(computer.compute_us(cycle), 300);
    ASSERT_FALSE(computer.misses(cycle));
  }
}

/// P(longer than x) = (1 + x / (3 tail))^-4.
TEST(Computer, TailHasItsShapeAndNothingIsFasterThanTheComputeTime) {
  const Computer computer(timing(50e-6, 0.0), 1);
  EXPECT_TRUE(computer.may_be_late(0));
  int over_one = 0, over_nine = 0;
  std::int64_t least = 1000;
  double sum_us = 0.0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const std::int64_t extra_us = computer.compute_us(cycle) - 300;
    least = std::min(least, extra_us);
    sum_us += static_cast<double>(extra_us);
    over_one += extra_us > 50 ? 1 : 0;
    over_nine += extra_us > 450 ? 1 : 0;
  }
  EXPECT_EQ(least, 0);
  EXPECT_NEAR(over_one, std::pow(4.0 / 3.0, -4.0) * kCycles, 0.01 * kCycles);
  EXPECT_NEAR(over_nine, std::pow(4.0, -4.0) * kCycles, 0.001 * kCycles);
  EXPECT_NEAR(sum_us / kCycles, 50.0, 1.0);
}

TEST(Computer, MissesItsShareOfTheCycles) {
  const Computer computer(timing(0.0, 0.001), 1);
  int missed = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) missed += computer.misses(cycle) ? 1 : 0;
  EXPECT_NEAR(missed, 0.001 * kCycles, 40);
}

TEST(Computer, NothingIsLateBeforeTheFirstCycle) {
  const Computer computer(timing(1e-3, 0.5), 1);
  EXPECT_EQ(computer.compute_us(-1), 300);
  EXPECT_FALSE(computer.may_be_late(-1));
  EXPECT_FALSE(computer.misses(-1));
}

TEST(Computer, EverySeedDrawsAnotherAndTheSameOneTheSame) {
  const Computer one(timing(50e-6, 0.5), 1), same(timing(50e-6, 0.5), 1), other(timing(50e-6, 0.5), 2);
  int equal = 0, both = 0;
  for (int cycle = 0; cycle < 1000; ++cycle) {
    ASSERT_EQ(one.compute_us(cycle), same.compute_us(cycle));
    ASSERT_EQ(one.misses(cycle), same.misses(cycle));
    equal += one.compute_us(cycle) == other.compute_us(cycle) ? 1 : 0;
    both += one.misses(cycle) == other.misses(cycle) ? 1 : 0;
  }
  EXPECT_LT(equal, 100);
  EXPECT_NEAR(both, 500, 80);
}

}  // namespace
}  // namespace sprung::sim
