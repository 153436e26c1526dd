#pragma once
/// Square root of a sum of squares, of torques, angles and the like: nothing whose square could overflow.
/// std::hypot guards against that, and costs several times as much.
#include <cmath>

namespace sprung {

inline double root_sum_square(double a, double b, double c = 0.0) noexcept {
  return std::sqrt(a * a + b * b + c * c);
}

}  // namespace sprung
