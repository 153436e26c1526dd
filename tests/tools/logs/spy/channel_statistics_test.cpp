#include <gtest/gtest.h>

#include "tools/logs/spy/channel_book.h"

namespace sprung::spy {
namespace {

TEST(ChannelStatistics, EvenMessagesHaveARateAndNoJitter) {
  ChannelStatistics statistics;
  for (int i = 0; i < 500; ++i) statistics.add(1'000'000 + 2000 * i, 100);
  const ChannelFigures figures = statistics.figures(1'000'000 + 2000 * 499 + 700);
  EXPECT_EQ(figures.messages, 500);
  EXPECT_DOUBLE_EQ(figures.rate_Hz, 500.0);
  EXPECT_DOUBLE_EQ(figures.jitter_us, 0.0);
  EXPECT_DOUBLE_EQ(figures.longest_us, 2000.0);
  EXPECT_DOUBLE_EQ(figures.bytes_per_s, 50'000.0);
  EXPECT_EQ(figures.last_size, 100u);
  EXPECT_EQ(figures.age_us, 700);
}

TEST(ChannelStatistics, JitterIsTheDeviationOfTheIntervals) {
  ChannelStatistics statistics;
  std::int64_t now_us = 0;
  for (int i = 0; i < 101; ++i) statistics.add(now_us += i % 2 == 0 ? 1500 : 2500, 1);
  const ChannelFigures figures = statistics.figures(now_us);
  EXPECT_DOUBLE_EQ(figures.rate_Hz, 500.0);
  EXPECT_DOUBLE_EQ(figures.jitter_us, 500.0);
  EXPECT_DOUBLE_EQ(figures.longest_us, 2500.0);
}

TEST(ChannelStatistics, OnlyTheLastTwoSecondsCount) {
  ChannelStatistics statistics;
  std::int64_t now_us = 0;
  for (int i = 0; i < 100; ++i) statistics.add(now_us += 10'000, 1);
  for (int i = 0; i < 600; ++i) statistics.add(now_us += 5'000, 1);
  EXPECT_DOUBLE_EQ(statistics.figures(now_us).rate_Hz, 200.0);
  EXPECT_EQ(statistics.figures(now_us).messages, 700);
}

TEST(ChannelStatistics, SlowChannelsHaveARateToo) {
  ChannelStatistics statistics;
  for (int i = 0; i < 4; ++i) statistics.add(4'000'000 * i, 1);
  EXPECT_DOUBLE_EQ(statistics.figures(12'000'000).rate_Hz, 0.25);
  EXPECT_DOUBLE_EQ(statistics.figures(16'000'000).rate_Hz, 0.25);
}

TEST(ChannelStatistics, ASilentChannelHasNoRate) {
  ChannelStatistics statistics;
  for (int i = 0; i < 100; ++i) statistics.add(2000 * i, 1);
  EXPECT_GT(statistics.figures(200'000 + 900'000).rate_Hz, 0.0);
  EXPECT_EQ(statistics.figures(200'000 + 1'100'000).rate_Hz, 0.0);
  EXPECT_EQ(statistics.figures(200'000 + 1'100'000).bytes_per_s, 0.0);
}

TEST(ChannelStatistics, OneMessageOrNoneHasNoRate) {
  ChannelStatistics statistics;
  EXPECT_EQ(statistics.figures(5).messages, 0);
  statistics.add(10, 7);
  EXPECT_EQ(statistics.figures(15).rate_Hz, 0.0);
  EXPECT_EQ(statistics.figures(15).age_us, 5);
  statistics.add(10, 7);  // at the very same time
  EXPECT_EQ(statistics.figures(15).rate_Hz, 0.0);
}

}  // namespace
}  // namespace sprung::spy
