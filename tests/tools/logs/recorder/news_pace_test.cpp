#include "tools/logs/recorder/news_pace.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprung {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

/// Seconds at which news is told when there is some in every second of [from, to).
std::vector<std::int64_t> told(NewsPace& pace, std::int64_t from_s, std::int64_t to_s) {
  std::vector<std::int64_t> when_s;
  for (std::int64_t s = from_s; s < to_s; ++s) {
    if (!pace.due(s * kSecond_us)) continue;
    when_s.push_back(s);
    pace.asked(s * kSecond_us, true);
  }
  return when_s;
}

TEST(NewsPace, FirstAtOnceThenEverMoreSeldom) {
  NewsPace pace;
  EXPECT_EQ(told(pace, 5, 200), (std::vector<std::int64_t>{5, 7, 11, 19, 35, 67, 131, 195}));
}

TEST(NewsPace, AfterAQuietTimeItIsSaidAtOnceAgain) {
  NewsPace pace;
  (void)told(pace, 0, 100);
  for (std::int64_t s = 100; s < 300; ++s) {
    if (pace.due(s * kSecond_us)) pace.asked(s * kSecond_us, false);
  }
  EXPECT_EQ(told(pace, 300, 310), (std::vector<std::int64_t>{300, 302, 306}));
}

}  // namespace
}  // namespace sprung
