#include "planner/gait/pace.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kTime_s = 0.2;      // in which the body stops or goes on where the clock does
constexpr double kCatchUp_s = 4.0;   // about a round of a crawl: feet go on even steps
constexpr double kMostLost_s = 1.0;  // of walking: what is more is forgotten, as after a push

}  // namespace

void Pace::advance(bool waits, const Speed& wanted, const Speed& fastest, double dt_s) noexcept {
  const double step = dt_s / kTime_s;
  now_ = waits ? std::max(0.0, now_ - step) : std::min(1.0, now_ + step);
  for (std::size_t i = 0; i < speed_.size(); ++i) {
    const double size = std::abs(wanted[i]);
    const double most = std::max(size, std::min((1.0 + kMost) * size, fastest[i]));
    speed_[i] = std::clamp(wanted[i] + lost_[i] / kCatchUp_s, -most, most);
    lost_[i] =
        std::clamp(lost_[i] + (wanted[i] - now_ * speed_[i]) * dt_s, -kMostLost_s * size, kMostLost_s * size);
  }
}

void Pace::lose(double forward_m, double left_m) noexcept {
  lost_[0] += forward_m;
  lost_[1] += left_m;
}

}  // namespace sprung
