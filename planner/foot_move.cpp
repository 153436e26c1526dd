#include "planner/foot_move.h"

#include "model/least_jerk.h"

namespace sprung {

FootPoint FootMove::at(double time_s) const noexcept {
  if (!(time_s < duration_s)) return {to_m, {}, {}};
  if (time_s <= 0.0) return {from_m, {}, {}};
  const LeastJerk s = least_jerk(time_s, duration_s);
  FootPoint out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = to_m[i] - from_m[i];
    out.position_m[i] = from_m[i] + s.share * way;
    out.velocity_m_s[i] = s.rate_1_s * way;
    out.acceleration_m_s2[i] = s.acceleration_1_s2 * way;
  }
  return out;
}

}  // namespace sprung
