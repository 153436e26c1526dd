#include "tools/logs/spy/channel_statistics.h"

#include <algorithm>
#include <cmath>

namespace sprung::spy {

namespace {

constexpr std::int64_t kWindow_us = 2'000'000;
constexpr std::int64_t kSlowWindow_us = 30'000'000;
constexpr std::size_t kFew = 5;
constexpr double kSilence_us = 1e6;  // and twice the longest interval: then it is silent, not late

}  // namespace

void ChannelStatistics::add(std::int64_t arrival_us, std::size_t size) {
  ++messages_;
  recent_.push_back({arrival_us, size});
  const auto old = [&](std::int64_t window_us) { return recent_.front().time_us < arrival_us - window_us; };
  while ((recent_.size() > kFew && old(kWindow_us)) || old(kSlowWindow_us)) recent_.pop_front();
}

ChannelFigures ChannelStatistics::figures(std::int64_t now_us) const {
  ChannelFigures out;
  out.messages = messages_;
  if (recent_.empty()) return out;
  out.last_size = recent_.back().size;
  out.age_us = now_us - recent_.back().time_us;
  const auto intervals = static_cast<double>(recent_.size() - 1);
  const auto span_us = static_cast<double>(recent_.back().time_us - recent_.front().time_us);
  if (span_us <= 0.0) return out;
  const double mean_us = span_us / intervals;
  double squares = 0.0, bytes = 0.0;
  for (std::size_t i = 1; i < recent_.size(); ++i) {
    const auto interval_us = static_cast<double>(recent_[i].time_us - recent_[i - 1].time_us);
    squares += (interval_us - mean_us) * (interval_us - mean_us);
    out.longest_us = std::max(out.longest_us, interval_us);
    bytes += static_cast<double>(recent_[i].size);
  }
  out.jitter_us = std::sqrt(squares / intervals);
  if (static_cast<double>(out.age_us) > std::max(2.0 * out.longest_us, kSilence_us)) return out;
  out.rate_Hz = 1e6 / mean_us;
  out.bytes_per_s = 1e6 * bytes / span_us;
  return out;
}

}  // namespace sprung::spy
