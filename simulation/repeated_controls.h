#pragma once
/// SIM_CONTROL has no acknowledgement, so senders publish it several times: one with the stamp of a former
/// one is the same again. Pure.
#include <algorithm>
#include <array>
#include <cstddef>

#include "signals/stamp.h"

namespace sprung::sim {

class RepeatedControls {
 public:
  static constexpr std::size_t kRemembered = 256;  ///< as many as a receive guard (EventFreshness)

  /// @return false for a (utime, seq) that was among the last kRemembered.
  bool is_new(const Stamp& stamp) noexcept {
    const auto same = [&](const Stamp& known) {
      return known.utime_us == stamp.utime_us && known.seq == stamp.seq;
    };
    const auto end = known_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kRemembered));
    if (std::any_of(known_.begin(), end, same)) return false;
    known_[count_++ % kRemembered] = stamp;
    return true;
  }

 private:
  std::array<Stamp, kRemembered> known_{};
  std::size_t count_ = 0;  ///< of all that were new
};

}  // namespace sprung::sim
