#include "planner/gait/speed_ramp.h"

#include <algorithm>

namespace sprung {

void SpeedRamp::advance(double dt_s) noexcept {
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const double most = most_[i] * dt_s;
    now_[i] += std::clamp(wanted_[i] - now_[i], -most, most);
  }
}

}  // namespace sprung
