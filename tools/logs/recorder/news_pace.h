#pragma once
/// How often the recorder says what went missing: at once, then ever more seldom while it goes on, so that a
/// busy machine does not bury all other lines. Pure.
#include <algorithm>
#include <cstdint>

namespace sprung {

class NewsPace {
 public:
  bool due(std::int64_t now_us) const noexcept { return now_us >= next_us_; }

  /// What was asked when it was due. @param anything whether there was news.
  void asked(std::int64_t now_us, bool anything) noexcept {
    pause_us_ = anything ? std::min(2 * pause_us_, kLongest_us) : std::max(pause_us_ / 2, kShortest_us);
    next_us_ = now_us + (anything ? pause_us_ : kShortest_us);
  }

 private:
  static constexpr std::int64_t kShortest_us = 1'000'000;
  static constexpr std::int64_t kLongest_us = 64'000'000;
  std::int64_t pause_us_ = kShortest_us;
  std::int64_t next_us_ = 0;
};

}  // namespace sprung
