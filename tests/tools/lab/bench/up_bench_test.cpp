#include "tools/lab/bench/up_bench.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

TEST(UpBench, TimesOneStartAndLeavesItsLog) {
  const std::filesystem::path folder = test::temp_dir() + "sprung_up_bench";
  std::filesystem::create_directories(folder);
  setenv("SPRUNG_PROGRAMS", test::bin_dir().c_str(), 1);
  setenv("SPRUNG_RUN_DIR", folder.c_str(), 1);
  setenv("SPRUNG_MIXED_BUILDS", "1", 1);
  const auto rows = bench_up(load_robot("single_leg"), 1, folder.string());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].name, "up.single_leg.ready");
  EXPECT_EQ(rows[0].high, 2.0);
  EXPECT_GT(rows[0].value, 0.0);
  EXPECT_EQ(rows[1].value, rows[0].value);
  EXPECT_GT(rows[2].value, 0.2) << "the recorder ends 0.2 s after the others";
  int logs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    logs += entry.path().extension() == ".lcm";
  EXPECT_EQ(logs, 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace sprung
