#include "tools/lab/bench/chain_bench.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "drivers/canopen/protocol.h"
#include "lcmtypes/channels.h"
#include "runtime/message_key.h"
#include "runtime/receive_guard.h"
#include "signals/quantile.h"
#include "tools/lab/bench/stopwatch.h"
#include "tools/logs/log/reader.h"

namespace sprung {
namespace {

constexpr std::size_t kMostFrames = 256;  // lcmtypes/can_trace.lcm

/// RPDO1 of some node.
bool is_set_point(int can_id) {
  const auto id = static_cast<std::uint32_t>(can_id);
  return id >= canopen::rpdo_id(0, 1) && id <= canopen::rpdo_id(0, canopen::kMaxNode);
}

/// Follows the bridge's own frames over the messages of a log.
class Cycles {
 public:
  void add(const sprung_msgs::traced_frame_t& frame) {
    if (frame.sent == 0) return;
    if (frame.can_id == static_cast<int>(canopen::kSyncId)) {
      begin(frame.utime);
    } else if (begun_ && is_set_point(frame.can_id)) {
      has_set_points_ = true;
      last_us_ = frame.utime;
    }
  }
  std::vector<double> times_us() {
    end();
    return times_us_;
  }

 private:
  /// The first SYNC behind set-points; further buses have theirs right after it.
  void begin(std::int64_t time_us) {
    if (begun_ && !has_set_points_) return;
    end();
    begun_ = true;
    has_set_points_ = false;
    sync_us_ = time_us;
  }
  void end() {
    if (begun_ && has_set_points_) times_us_.push_back(static_cast<double>(last_us_ - sync_us_));
    begun_ = false;
  }

  std::vector<double> times_us_;
  bool begun_ = false, has_set_points_ = false;
  std::int64_t sync_us_ = 0, last_us_ = 0;
};

}  // namespace

ChainTimes chain_times(const std::string& log) {
  log::Reader reader(log);
  ReceiveGuard guard(channels::kCanTrace, layout_of<sprung_msgs::can_trace_t>(),
                     CountLimits::up_to(kMostFrames), 0);
  sprung_msgs::can_trace_t trace;
  Cycles cycles;
  for (log::Event event; reader.next(event);) {
    if (event.channel != channels::kCanTrace) continue;
    if (guard.decode(event.data, event.size, trace) != Refusal::kNone || trace.seq < 0) continue;
    for (const sprung_msgs::traced_frame_t& frame : trace.frames) cycles.add(frame);
  }
  const std::vector<double> times_us = cycles.times_us();
  if (times_us.empty()) throw std::runtime_error(log + ": no cycle with a SYNC and a set-point in CAN_TRACE");
  return {times_us.size(), quantile(times_us, 0.5), quantile(times_us, 0.99)};
}

std::vector<ReportRow> bench_chain(const std::vector<std::string>& logs) {
  std::vector<ReportRow> rows;
  std::vector<double> p50_us, p99_us;
  for (const std::string& log : logs) {
    const ChainTimes times = chain_times(log);
    const std::string prefix = "chain." + std::filesystem::path(log).stem().string() + ".";
    rows.push_back(row(prefix + "cycles", "", static_cast<double>(times.cycles)));
    rows.push_back(row(prefix + "p50", "us", times.p50_us));
    rows.push_back(row(prefix + "p99", "us", times.p99_us));
    p50_us.push_back(times.p50_us);
    p99_us.push_back(times.p99_us);
  }
  const std::size_t half = logs.size() / 2;
  if (half == 0) return rows;
  const auto ratio = [half](const std::vector<double>& all) {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(half);
    return median({all.begin(), middle}) / median({middle, all.end()});
  };
  rows.push_back(row("chain.ratio.p50", "", ratio(p50_us)));
  rows.push_back(row("chain.ratio.p99", "", ratio(p99_us)));
  return rows;
}

std::vector<ReportRow> bench_mac(int runs) {
  constexpr int kCalls = 2000;
  const MessageKey key(std::array<std::uint8_t, kKeyBytes>{1});
  std::vector<ReportRow> rows;
  for (const std::size_t size : {150U, 300U, 700U, 1200U, 2600U}) {
    std::vector<std::uint8_t> bytes(size);
    const Measured measured = measure(runs, [&] {
      return time_ns([&] {
               for (int i = 0; i < kCalls; ++i) key.seal(channels::kDriveCommand, bytes.data(), bytes.size());
             }) /
             kCalls;
    });
    const std::string prefix = "mac." + std::to_string(size) + "_bytes.";
    rows.push_back(row(prefix + "time", "us", 1e-3 * measured.ns));
    rows.push_back(row(prefix + "ratio", "", measured.ratio));
  }
  return rows;
}

}  // namespace sprung
