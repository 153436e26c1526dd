#include "tools/lab/bench/chain_bench.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lcmtypes/channels.h"
#include "sprung_msgs/can_trace_t.hpp"
#include "tests/signals/message_bytes.h"
#include "tests/support/own_folder.h"
#include "tools/logs/log/writer.h"

namespace sprung {
namespace {

class ChainBench : public testing::Test {
 protected:
  static sprung_msgs::traced_frame_t frame(std::int64_t utime_us, int id, bool sent) {
    sprung_msgs::traced_frame_t out{};
    out.utime = utime_us;
    out.can_id = id;
    out.sent = sent ? 1 : 0;
    return out;
  }
  /// Cycles whose last set-point is so many us behind their SYNC; answers and other frames between.
  std::string log_of(const std::string& name, const std::vector<std::int64_t>& spans_us) {
    const std::string path = folder_ / (name + ".lcm");
    log::Writer writer(path, 1 << 16);
    std::int64_t seq = 0;
    for (const std::int64_t span_us : spans_us) {
      sprung_msgs::can_trace_t trace{};
      const std::int64_t sync_us = 2000 * seq + 7;
      trace.seq = seq++;
      trace.frames = {frame(sync_us, 0x080, true), frame(sync_us + 90, 0x181, false),
                      frame(sync_us + span_us - 5, 0x201, true), frame(sync_us + span_us, 0x202, true),
                      frame(sync_us + span_us + 50, 0x77F, true)};
      trace.n = static_cast<std::int32_t>(trace.frames.size());
      const std::vector<std::uint8_t> bytes = test::encoded(trace);
      writer.write({seq, sync_us, channels::kCanTrace, bytes.data(), bytes.size()});
    }
    return path;
  }
  const test::OwnFolder folder_{"chain"};
};

TEST_F(ChainBench, TimeIsFromTheSyncToTheLastSetPointOfItsCycle) {
  std::vector<std::int64_t> spans_us;
  for (int k = 0; k < 100; ++k) spans_us.push_back(100 + 10 * ((37 * k) % 100));  // 100 to 1090, mixed
  const ChainTimes times = chain_times(log_of("one", spans_us));
  EXPECT_EQ(times.cycles, 100u);
  EXPECT_EQ(times.p50_us, 600.0);
  EXPECT_EQ(times.p99_us, 1090.0);
}

TEST_F(ChainBench, FirstHalfOfTheLogsIsComparedWithTheSecond) {
  const auto rows = bench_chain({log_of("new", {330, 330, 330}), log_of("old", {300, 300, 300})});
  EXPECT_EQ(rows.back().name, "chain.ratio.p99");
  EXPECT_DOUBLE_EQ(rows.back().value, 1.1);
}

TEST_F(ChainBench, LogWithoutACycleIsRefused) {
  EXPECT_THROW(chain_times(log_of("none", {})), std::runtime_error);
}

TEST(MacBench, EachSizeTakesTimeAndHasItsRatio) {
  const auto rows = bench_mac(1);
  ASSERT_EQ(rows.size(), 10u);
  for (const ReportRow& one : rows) EXPECT_GT(one.value, 0.0) << one.name;
}

}  // namespace
}  // namespace sprung
