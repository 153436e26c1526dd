#include "tools/lab/bench/replay_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"

namespace sprung {
namespace {

TEST(ReplayBench, LogOfATrotIsReproducedAndEachPartIsMeasured) {
  const std::string folder = test::temp_dir() + "replay-bench";
  const std::vector<ReportRow> rows = bench_replay(load_robot("pegasus"), 1, 0.5, folder);
  const auto value = [&](const std::string& name) {
    const auto found = std::find_if(
        rows.begin(), rows.end(), [&](const ReportRow& row) { return row.name == "replay.pegasus." + name; });
    EXPECT_NE(found, rows.end()) << name;
    return found == rows.end() ? 0.0 : found->value;
  };
  EXPECT_EQ(value("differing"), 0.0);
  EXPECT_GT(value("compared"), 4 * 1000.0);
  EXPECT_GT(value("times_real_time"), 1.0);
  EXPECT_GT(value("cycle"), value("file"));
  EXPECT_GT(value("estimator"), 0.0);
  std::filesystem::remove_all(folder);
}

TEST(ReplayBench, RobotThatDoesNotWalkIsRefused) {
  EXPECT_THROW(bench_replay(load_robot("single_leg"), 1, 0.5, test::temp_dir() + "replay-bench-leg"),
               std::invalid_argument);
}

}  // namespace
}  // namespace sprung
