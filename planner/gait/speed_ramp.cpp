#include "planner/gait/speed_ramp.h"

#include <algorithm>
#include <cmath>

namespace sprung {

void SpeedRamp::stop(double within_s) noexcept {
  want({});
  for (std::size_t i = 0; i < now_.size(); ++i)
    times_ = std::max(times_, std::abs(now_[i]) / (most_[i] * within_s));
}

double SpeedRamp::left_s() const noexcept {
  double left_s = 0.0;
  for (std::size_t i = 0; i < now_.size(); ++i)
    left_s = std::max(left_s, std::abs(wanted_[i] - now_[i]) / (times_ * most_[i]));
  return left_s;
}

void SpeedRamp::advance(double dt_s, const std::array<double, 3>& most_faster) noexcept {
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const bool faster = std::abs(wanted_[i]) > std::abs(now_[i]) && wanted_[i] * now_[i] >= 0.0;
    const double most = (faster ? std::min(most_[i], most_faster[i]) : times_ * most_[i]) * dt_s;
    now_[i] += std::clamp(wanted_[i] - now_[i], -most, most);
  }
}

}  // namespace sprung
