#pragma once
/// Three numbers along axes, and what stands for "not known".
#include <array>
#include <cmath>
#include <limits>

namespace sprung {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Vec3 = std::array<double, 3>;

inline bool finite(const Vec3& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace sprung
