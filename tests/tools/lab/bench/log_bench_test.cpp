#include "tools/lab/bench/log_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/log/verify.h"

namespace sprung::log {
namespace {

class LogBench : public testing::Test {
 protected:
  LogFolder folder_;
  std::string short_ = folder_("short.lcm"), long_ = folder_("long.lcm");
};

TEST_F(LogBench, ARepeatedLogIsALogOfSoManySessionsOneBehindTheOther) {
  std::vector<Kept> events;
  for (int k = 0; k < 50; ++k) events.push_back(joint_event(k));
  write_all(short_, events);
  const std::uint64_t once = bytes_of(short_).size();
  repeat_log(short_, long_, 3 * once);
  Reader reader(long_);
  const LogInfo info = collect_info(reader);
  EXPECT_EQ(info.bytes, 3 * once);
  EXPECT_EQ(info.events, 150);
  EXPECT_EQ(info.sessions, 3u);
  EXPECT_EQ(info.missing(), 0);
  EXPECT_EQ(info.went_back, 0);
  EXPECT_NEAR(info.duration_s, 3 * 49 * 0.002, 1e-3);
  Reader again(long_);
  EXPECT_TRUE(verify(again).good());
}

TEST_F(LogBench, ALogWithoutEventsCannotBeRepeated) {
  write_all(short_, {});
  EXPECT_THROW(repeat_log(short_, long_, 1000), std::invalid_argument);
}

TEST_F(LogBench, EachToolHasARowAndSoHasMemory) {
  write_all(short_, robot_events(500));
  std::set<std::string> names;
  for (const ReportRow& row : bench_log(short_, 1)) {
    EXPECT_GT(row.value, 0.0) << row.name;
    names.insert(row.name);
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"log.size", "log.read_alone", "log.info", "log.verify", "log.csv_torques",
                                   "log.csv_everything", "log.mcap", "log.mcap_size", "log.memory"}));
}

}  // namespace
}  // namespace sprung::log
