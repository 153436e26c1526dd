#pragma once
/// Slow straight move of a foot, at rest at both ends: the polynomial of degree five with least jerk (Flash
/// and Hogan 1985), s = 10 x^3 - 15 x^4 + 6 x^5. Pure.
#include "signals/vec3.h"

namespace sprung {

struct FootPoint {
  Vec3 position_m{};  ///< hip axes
  Vec3 velocity_m_s{};
  Vec3 acceleration_m_s2{};
};

struct FootMove {
  Vec3 from_m{};
  Vec3 to_m{};
  double duration_s = 0.0;  ///< 0: at the end at once

  /// Rests at the nearer end outside [0, duration].
  FootPoint at(double time_s) const noexcept;
};

}  // namespace sprung
