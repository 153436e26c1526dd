#include "tools/lab/bench/can_bench.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"
#include "tools/lab/bench/stopwatch.h"

namespace sprung {
namespace {

const ReportRow* find(const std::vector<ReportRow>& rows, const std::string& name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const ReportRow& r) { return r.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

TEST(Stopwatch, MedianIsTheMiddleOne) {
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 2}), 2);
  EXPECT_EQ(median({7}), 7);
}

TEST(Stopwatch, MeasureTakesTheMedianOfTheRuns) {
  const std::vector<double> given{30, 10, 20};
  std::size_t next = 0;
  const Measured measured = measure(3, [&] { return given[next++]; });
  EXPECT_EQ(next, 3u);
  EXPECT_EQ(measured.ns, 20);
  EXPECT_GT(measured.ratio, 0);
}

TEST(CanBench, EveryCodecHasATimeAndARatio) {
  const std::vector<ReportRow> rows = bench_codecs(1);
  for (const char* codec : {"udp.encode", "udp.decode", "socketcan.encode", "socketcan.decode"}) {
    const ReportRow* time = find(rows, std::string("can.") + codec);
    const ReportRow* ratio = find(rows, std::string("can.") + codec + "_ratio");
    ASSERT_TRUE(time && ratio) << codec;
    EXPECT_GT(time->value, 0);
    EXPECT_GT(ratio->value, 0);
  }
}

TEST(CanBench, ShareIsTheCycleTimeOverTheRobotsCycle) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/single_leg");
  const std::vector<ReportRow> rows = bench_bridge(robot, 1, 20);
  const ReportRow* cycle = find(rows, "can.single_leg.bridge_cycle");
  const ReportRow* share = find(rows, "can.single_leg.bridge_share");
  ASSERT_TRUE(cycle && share);
  EXPECT_NEAR(share->value, 100.0 * cycle->value * 1e-9 / robot.cycle_s, 1e-9);
  EXPECT_EQ(share->high, 15.0);
}

}  // namespace
}  // namespace sprung
