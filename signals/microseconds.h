#pragma once
/// Seconds of configurations as the microseconds that message time counts in.
#include <cmath>
#include <cstdint>

namespace sprung {

inline std::int64_t to_us(double seconds) noexcept {
  return static_cast<std::int64_t>(std::llround(1e6 * seconds));
}

}  // namespace sprung
