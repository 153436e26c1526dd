#include "runtime/loop_statistics.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(SampleWindow, MedianAndMaximum) {
  SampleWindow window;
  EXPECT_EQ(window.median(), 0.0);
  EXPECT_EQ(window.max(), 0.0);
  for (const double sample : {5.0, 1.0, 100.0, 2.0, 3.0}) window.add(sample);
  EXPECT_EQ(window.median(), 3.0);
  EXPECT_EQ(window.max(), 100.0);
  window.clear();
  window.add(-4.0);
  EXPECT_EQ(window.median(), -4.0);
  EXPECT_EQ(window.max(), -4.0);
}

TEST(SampleWindow, OverflowKeepsTheNewestAndTheTrueMaximum) {
  SampleWindow window;
  window.add(1e6);
  for (std::size_t i = 0; i < SampleWindow::kCapacity; ++i) window.add(7.0);
  EXPECT_EQ(window.median(), 7.0);
  EXPECT_EQ(window.max(), 1e6);
}

TEST(LoopStatistics, MeasuresPeriodAndComputeTime) {
  LoopStatistics statistics(500.0);
  for (int cycle = 0; cycle < 5; ++cycle) {
    statistics.begin_cycle(1000 * cycle);
    EXPECT_FALSE(statistics.end_cycle(1000 * cycle + 100));
  }
  const LoopSummary summary = statistics.summarize();
  EXPECT_EQ(summary.period_median_us, 1000.0);
  EXPECT_EQ(summary.period_max_us, 1000.0);
  EXPECT_EQ(summary.compute_median_us, 100.0);
  EXPECT_EQ(summary.overruns, 0);
  EXPECT_EQ(statistics.cycles(), 5);
}

TEST(LoopStatistics, CountsOverrunsOverTheWholeRun) {
  LoopStatistics statistics(500.0);
  statistics.begin_cycle(0);
  EXPECT_TRUE(statistics.end_cycle(501));
  EXPECT_EQ(statistics.summarize().compute_max_us, 501.0);
  statistics.begin_cycle(1000);
  EXPECT_FALSE(statistics.end_cycle(1500));
  const LoopSummary second = statistics.summarize();
  EXPECT_EQ(second.overruns, 1);
  EXPECT_EQ(second.compute_max_us, 500.0);
  EXPECT_EQ(second.period_max_us, 1000.0);
}

TEST(LoopStatistics, WithoutABudgetNothingOverruns) {
  LoopStatistics statistics;
  statistics.begin_cycle(0);
  EXPECT_FALSE(statistics.end_cycle(1'000'000'000));
}

}  // namespace
}  // namespace sprung
