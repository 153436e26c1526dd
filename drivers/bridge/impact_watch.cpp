#include "drivers/bridge/impact_watch.h"

#include <algorithm>
#include <limits>

#include "signals/microseconds.h"

namespace sprung {
namespace {

constexpr double kImpactSpan_s = 0.004;
/// [design choice] Jumps and gaits of healthy robots stay below half of it (tests/simulation,
/// ImpactInMotion); a stop that single_leg hits at 12 rad/s gives 8.
constexpr double kTimesItsTorque = 3.0;

}  // namespace

ImpactWatch::ImpactWatch(double torque_limit_Nm, double inertia_kg_m2, double cycle_s) noexcept
    : cycle_us_(to_us(cycle_s)),
      span_(std::clamp(static_cast<int>(std::lround(kImpactSpan_s / cycle_s)), 1, kMostSpan)),
      span_s_(span_ * cycle_s),
      most_rad_s_(inertia_kg_m2 > 0.0 ? kTimesItsTorque * torque_limit_Nm / inertia_kg_m2 * 2.0 * span_s_
                                      : std::numeric_limits<double>::infinity()) {}

void ImpactWatch::add(double position_rad, std::int64_t sync_us) noexcept {
  if (hit()) return;
  if (sync_us - last_us_ != cycle_us_) known_ = 0;
  last_us_ = sync_us;
  const int size = 3 * span_ + 1;
  const auto before_rad = [&](int spans) {
    const int place = next_ - spans * span_;
    return position_rad_[place < 0 ? place + size : place];
  };
  position_rad_[next_] = position_rad;
  known_ = std::min(known_ + 1, size);
  if (known_ == size)
    change_rad_s_ = (position_rad - before_rad(1) - before_rad(2) + before_rad(3)) / span_s_;
  next_ = next_ + 1 == size ? 0 : next_ + 1;
}

}  // namespace sprung
