#pragma once
/// Time of a session: us on CLOCK_MONOTONIC since the epoch that `sprung up` gives to every process, so that
/// all agree.
#include <cstdint>

namespace sprung {

std::int64_t monotonic_us() noexcept;  ///< CLOCK_MONOTONIC
std::int64_t utc_us() noexcept;        ///< CLOCK_REALTIME, since 1970

class SessionClock {
 public:
  /// @param epoch_us monotonic_us() when the session began; 0 = when the machine booted.
  explicit SessionClock(std::int64_t epoch_us) noexcept : epoch_us_(epoch_us) {}
  std::int64_t utime_us() const noexcept { return monotonic_us() - epoch_us_; }
  std::int64_t utc_offset_us() const noexcept { return utc_us() - utime_us(); }
  std::int64_t epoch_us() const noexcept { return epoch_us_; }

 private:
  std::int64_t epoch_us_;
};

}  // namespace sprung
