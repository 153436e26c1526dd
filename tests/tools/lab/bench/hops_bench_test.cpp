#include "tools/lab/bench/hops_bench.h"

#include <gtest/gtest.h>

#include <string>

namespace sprung {
namespace {

TEST(HopsBenchTest, BothReceiversBringMessagesThroughFourHops) {
  HopsBench bench;
  bench.runs = 1;
  bench.messages = 20;
  double ours_us = 0.0, lcm_us = 0.0, ratio = 0.0;
  for (const ReportRow& row : bench_hops(bench)) {
    if (row.name == "hops.ours_p50") ours_us = row.value;
    if (row.name == "hops.lcm_p50") lcm_us = row.value;
    if (row.name == "hops.ratio_p50") ratio = row.value;
  }
  EXPECT_GT(ours_us, 0.0);
  EXPECT_GT(lcm_us, 0.0);
  EXPECT_DOUBLE_EQ(ratio, ours_us / lcm_us);
}

}  // namespace
}  // namespace sprung
