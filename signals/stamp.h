#pragma once
/// Identity of one cycle, carried by every signal and message.
#include <cstdint>

namespace sprung {

struct Stamp {
  std::int64_t utime_us = 0;  ///< monotonic, since the session began
  std::int64_t seq = -1;      ///< cycle of the DRIVE_STATE it answers; -1 = before cycle 0
};

inline double seconds(std::int64_t time_us) noexcept { return 1e-6 * static_cast<double>(time_us); }

}  // namespace sprung
