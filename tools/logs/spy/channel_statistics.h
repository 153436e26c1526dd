#pragma once
/// How often a channel's messages come, how evenly, and how large they are. From times of arrival alone.
/// Pure.
#include <cstddef>
#include <cstdint>
#include <deque>

namespace sprung::spy {

struct ChannelFigures {
  std::int64_t messages = 0;  ///< since it was first heard
  double rate_Hz = 0.0;       ///< of the last 2 s (of slower channels the last 5 messages); 0 = silent
  double jitter_us = 0.0;     ///< rms deviation of the intervals from their mean
  double longest_us = 0.0;    ///< longest interval among them
  double bytes_per_s = 0.0;
  std::size_t last_size = 0;  ///< bytes
  std::int64_t age_us = 0;    ///< since the last one
};

class ChannelStatistics {
 public:
  void add(std::int64_t arrival_us, std::size_t size);
  /// @param now_us on the clock of the arrivals.
  ChannelFigures figures(std::int64_t now_us) const;

 private:
  struct Arrival {
    std::int64_t time_us;
    std::size_t size;
  };
  std::deque<Arrival> recent_;
  std::int64_t messages_ = 0;
};

}  // namespace sprung::spy
