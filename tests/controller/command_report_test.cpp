#include "controller/command_report.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

using News = CommandReport::News;

TEST(CommandReportTest, EveryChangeOfBasisIsNewsOnce) {
  CommandReport report;
  EXPECT_EQ(report.update(CommandBasis::kNoCommand, {}, 0), News::kBasis);
  EXPECT_EQ(report.text(), "no leg command yet");
  EXPECT_EQ(report.update(CommandBasis::kNoCommand, {}, 1000), News::kNone);
  EXPECT_EQ(report.update(CommandBasis::kCommanded, {}, 2000), News::kBasis);
  EXPECT_EQ(report.update(CommandBasis::kUnreachable, {}, 3000), News::kBasis);
  EXPECT_EQ(report.text(), "foot out of reach");
}

TEST(CommandReportTest, LimitsAreNamedWhenTheirCountsGrow) {
  CommandReport report;
  LimitCounts limits;
  report.update(CommandBasis::kCommanded, limits, 0);
  limits.torque = 12;
  limits.rate = 3;
  EXPECT_EQ(report.update(CommandBasis::kCommanded, limits, 1000), News::kLimits);
  EXPECT_EQ(report.text(), "commanded; limits acted: torque 12, rate 3");
  limits.soft_stop = limits.speed = limits.power = limits.position = limits.velocity = limits.window = 1;
  report.update(CommandBasis::kCommanded, limits, 2'000'000);
  EXPECT_EQ(report.text(),
            "commanded; limits acted: soft stop 1, torque 12, speed 1, power 1, rate 3, position 1, velocity "
            "1, window 1");
}

TEST(CommandReportTest, LimitsThatActInEveryCycleAreNewsOnceASecondAndAllocateNothingBetween) {
  CommandReport report;
  LimitCounts limits;
  report.update(CommandBasis::kCommanded, limits, 0);
  int news = 0;
  std::int64_t allocated_quietly = 0;
  for (std::int64_t now_us = 1000; now_us <= 5'000'000; now_us += 1000) {
    ++limits.rate;
    const std::int64_t before = test::allocation_count();
    const bool quiet = report.update(CommandBasis::kCommanded, limits, now_us) == News::kNone;
    if (quiet) allocated_quietly += test::allocation_count() - before;
    news += quiet ? 0 : 1;
  }
  EXPECT_EQ(news, 5);
  EXPECT_EQ(allocated_quietly, 0);
}

TEST(CommandReportTest, ChangeOfBasisDoesNotWaitForTheLimits) {
  CommandReport report;
  LimitCounts limits;
  limits.rate = 1;
  report.update(CommandBasis::kCommanded, limits, 0);
  limits.rate = 2;
  EXPECT_EQ(report.update(CommandBasis::kSafety, limits, 1), News::kBasis);
  EXPECT_EQ(report.text(), std::string(name(CommandBasis::kSafety)) + "; limits acted: rate 2");
}

}  // namespace
}  // namespace sprung
