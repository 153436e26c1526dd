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

bool SpeedRamp::grows(std::size_t axis) const noexcept {
  return std::abs(wanted_[axis]) > std::abs(now_[axis]) && wanted_[axis] * now_[axis] >= 0.0;
}

/// Share of its most that each of the growing speeds may take: a foot is left behind by all of them at once.
std::array<double, 3> SpeedRamp::shares(const std::array<double, 3>& most_faster) const noexcept {
  std::array<double, 3> out{1.0, 1.0, 1.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    if (!grows(i) || !(most_faster[i] > 0.0)) continue;
    out[i] = std::abs(wanted_[i] - now_[i]) / most_faster[i];
    sum += out[i] * out[i];
  }
  for (std::size_t i = 0; i < now_.size(); ++i)
    if (grows(i) && most_faster[i] > 0.0) out[i] /= std::sqrt(sum);
  return out;
}

void SpeedRamp::advance(double dt_s, const std::array<double, 3>& most_faster) noexcept {
  const std::array<double, 3> share = shares(most_faster);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const double most = (grows(i) ? std::min(most_[i], share[i] * most_faster[i]) : times_ * most_[i]) * dt_s;
    now_[i] += std::clamp(wanted_[i] - now_[i], -most, most);
  }
}

}  // namespace sprung
