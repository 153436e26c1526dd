#include "tools/lab/bench/recorder_bench.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

const ReportRow& row(const std::vector<ReportRow>& rows, const std::string& name) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const ReportRow& r) { return r.name == name; });
  EXPECT_NE(found, rows.end()) << name;
  return *found;
}

TEST(RecorderBench, OwnRecorderLosesNothingAndLcmLoggerIsMeasuredBesideIt) {
  setenv("SPRUNG_PROGRAMS", test::bin_dir().c_str(), 1);
  RecorderBench bench;
  bench.runs = 2;
  bench.messages = 500;
  bench.rate_Hz = 1000.0;
  bench.hogs = 1;
  bench.folder = test::temp_dir() + "recorder-bench";
  int said = 0;
  bench.on_run = [&](int) { ++said; };
  const std::vector<ReportRow> rows = bench_recorder(bench);
  EXPECT_EQ(said, 2);
  EXPECT_EQ(row(rows, "recorder.sent").value, 1000.0);
  EXPECT_EQ(row(rows, "recorder.lost").value, 0.0);
  EXPECT_TRUE(row(rows, "recorder.lost").ok());
  EXPECT_GE(row(rows, "recorder.lcm_logger_lost").value, 0.0);
  EXPECT_LT(row(rows, "recorder.lcm_logger_lost").value, 1000.0);  // it did run
  EXPECT_TRUE(std::filesystem::is_empty(bench.folder));
  std::filesystem::remove_all(bench.folder);
}

}  // namespace
}  // namespace sprung
