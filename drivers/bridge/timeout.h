#pragma once
/// How long lock-step waits for a partner before it goes on without: long at first, since a busy machine may
/// be slow, then short while the partner stays away, so that watchdogs, which count message time, run out
/// soon. Pure.
#include <cstdint>

namespace sprung {

class Timeout {
 public:
  static constexpr std::int64_t kRepeat_us = 50'000;    ///< ask again after this
  static constexpr std::int64_t kFirst_us = 1'000'000;  ///< a partner that was there may take this long
  static constexpr std::int64_t kGone_us = 5'000;       ///< one that already failed to answer

  void begin(std::int64_t now_us) noexcept {
    begun_us_ = now_us;
    next_repeat_us_ = now_us + kRepeat_us;
  }
  bool repeat_due(std::int64_t now_us) noexcept {
    if (now_us < next_repeat_us_) {
      return false;
    }
    next_repeat_us_ = now_us + kRepeat_us;
    return true;
  }
  bool over(std::int64_t now_us) const noexcept {
    return now_us - begun_us_ >= (gone_ ? kGone_us : kFirst_us);
  }
  std::int64_t wake_us() const noexcept {
    const std::int64_t end_us = begun_us_ + (gone_ ? kGone_us : kFirst_us);
    return end_us < next_repeat_us_ ? end_us : next_repeat_us_;
  }
  void answered() noexcept { gone_ = false; }
  void gave_up() noexcept { gone_ = true; }

 private:
  std::int64_t begun_us_ = 0;
  std::int64_t next_repeat_us_ = 0;
  bool gone_ = false;
};

}  // namespace sprung
