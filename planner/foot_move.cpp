#include "planner/foot_move.h"

namespace sprung {

FootPoint FootMove::at(double time_s) const noexcept {
  if (!(time_s < duration_s)) return {to_m, {}, {}};
  if (time_s <= 0.0) return {from_m, {}, {}};
  const double x = time_s / duration_s;
  const double rest = 1.0 - x;
  const double share = x * x * x * (10.0 + x * (6.0 * x - 15.0));
  const double rate = 30.0 * x * x * rest * rest / duration_s;
  const double acceleration = 60.0 * x * rest * (1.0 - 2.0 * x) / (duration_s * duration_s);
  FootPoint out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = to_m[i] - from_m[i];
    out.position_m[i] = from_m[i] + share * way;
    out.velocity_m_s[i] = rate * way;
    out.acceleration_m_s2[i] = acceleration * way;
  }
  return out;
}

}  // namespace sprung
