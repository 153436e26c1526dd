#include "tools/station/gateway/replay_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tools/station/gateway/token_bucket.h"

namespace sprung::gateway {
namespace {

bool take(ReplayWindow& window, std::uint64_t number) {
  const bool is_new = window.is_new(number);
  if (is_new) window.take(number);
  return is_new;
}

TEST(ReplayWindow, TakesEachNumberOnceInAnyOrderWithinItsReach) {
  std::mt19937 random(1);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t n = 1; n <= 5000; ++n) numbers.push_back(n);
  for (std::size_t i = 0; i + 100 < numbers.size(); i += 100)
    std::shuffle(numbers.begin() + static_cast<long>(i), numbers.begin() + static_cast<long>(i) + 200 - 100,
                 random);
  ReplayWindow window;
  for (const std::uint64_t n : numbers) EXPECT_TRUE(take(window, n)) << n;
  for (const std::uint64_t n : numbers) EXPECT_FALSE(take(window, n)) << n;
}

TEST(ReplayWindow, WhatIsFarBehindIsNotNew) {
  ReplayWindow window;
  EXPECT_FALSE(window.is_new(0));
  EXPECT_TRUE(take(window, 1000));
  EXPECT_TRUE(take(window, 1000 - ReplayWindow::kBehind + 1));
  EXPECT_FALSE(take(window, 1000 - ReplayWindow::kBehind));
  EXPECT_TRUE(take(window, ~0ull));
  EXPECT_FALSE(take(window, 999));
  EXPECT_FALSE(take(window, ~0ull));
}

TEST(ReplayWindow, ALookChangesNothing) {
  ReplayWindow window;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(window.is_new(7));
}

TEST(TokenBucket, GivesSomeAtOnceAndThenItsRate) {
  TokenBucket bucket(10.0, 5.0);
  int count = 0;
  for (int k = 0; k < 20; ++k) count += bucket.take(1'000'000) ? 1 : 0;
  EXPECT_EQ(count, 5);
  EXPECT_TRUE(bucket.take(1'110'000));
  EXPECT_FALSE(bucket.take(1'120'000));
  for (int k = 0; k < 1000; ++k) count += bucket.take(2'000'000 + 10'000 * k) ? 1 : 0;
  EXPECT_NEAR(count, 5 + 5 + 100, 3);
}

}  // namespace
}  // namespace sprung::gateway
