#pragma once
/// Slow straight move of a foot, at rest at both ends, with least jerk (model/least_jerk.h). Pure.
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
