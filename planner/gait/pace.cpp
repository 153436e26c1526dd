#include "planner/gait/pace.h"

#include <algorithm>
#include <cmath>

#include "robots/gait_speed.h"

namespace sprung {
namespace {

constexpr double kTime_s = 0.2;      // in which the body stops or goes on where the clock does
constexpr double kCatchUp_s = 4.0;   // about a round of a crawl: feet go on even steps
constexpr double kMostLost_s = 1.0;  // of walking: what is more is forgotten, as after a push

}  // namespace

void Pace::advance(bool waits, const Speed& wanted, const GaitConfig& gait, double dt_s) noexcept {
  const double step = dt_s / kTime_s;
  now_ = waits ? std::max(0.0, now_ - step) : std::min(1.0, now_ + step);
  for (std::size_t i = 0; i < speed_.size(); ++i) {
    const double most = kMost * std::abs(wanted[i]);
    speed_[i] = wanted[i] + std::clamp(lost_[i] / kCatchUp_s, -most, most);
  }
  slow_down(std::max(speed_share(gait, wanted), kMostSpeedShare), gait);
  for (std::size_t i = 0; i < speed_.size(); ++i) {
    const double most = kMostLost_s * std::abs(wanted[i]);
    lost_[i] = std::clamp(lost_[i] + (wanted[i] - now_ * speed_[i]) * dt_s, -most, most);
  }
}

void Pace::slow_down(double most_share, const GaitConfig& gait) noexcept {
  const double share = speed_share(gait, speed_);
  if (!(share > most_share) || !std::isfinite(share)) return;
  for (double& speed : speed_) speed *= most_share / share;
}

void Pace::lose(double forward_m, double left_m) noexcept {
  if (!std::isfinite(forward_m) || !std::isfinite(left_m)) return;
  lost_[0] += forward_m;
  lost_[1] += left_m;
}

}  // namespace sprung
