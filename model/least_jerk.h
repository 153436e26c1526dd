#pragma once
/// From 0 to 1 and at rest at both ends: the polynomial of degree five with least jerk (Flash and Hogan
/// 1985), s = 10 x^3 - 15 x^4 + 6 x^5. Pure.
#include <algorithm>

namespace sprung {

struct LeastJerk {
  double share;
  double rate_1_s;
  double acceleration_1_s2;
};

/// @param duration_s positive. Rests at the nearer end outside [0, duration].
inline LeastJerk least_jerk(double time_s, double duration_s) noexcept {
  const double x = std::clamp(time_s / duration_s, 0.0, 1.0);
  const double rest = 1.0 - x;
  return {x * x * x * (10.0 + x * (6.0 * x - 15.0)), 30.0 * x * x * rest * rest / duration_s,
          60.0 * x * rest * (1.0 - 2.0 * x) / (duration_s * duration_s)};
}

}  // namespace sprung
