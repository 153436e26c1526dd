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
/// [design choice] Gears twist by 11 mrad at most, and encoders answer to one SYNC.
constexpr double kWentAlong_rad = 0.02;
constexpr double kStays_rad = 0.02, kPushesShare = 0.5;
constexpr std::int64_t kStays_us = 60'000;

}  // namespace

ImpactWatch::ImpactWatch(double torque_limit_Nm, double inertia_kg_m2, double cycle_s) noexcept
    : limit_Nm_(torque_limit_Nm),
      cycle_us_(to_us(cycle_s)),
      span_(std::clamp(static_cast<int>(std::lround(kImpactSpan_s / cycle_s)), 1, kMostSpan)),
      span_s_(span_ * cycle_s),
      most_rad_s_(inertia_kg_m2 > 0.0 ? kTimesItsTorque * torque_limit_Nm / inertia_kg_m2 * 2.0 * span_s_
                                      : std::numeric_limits<double>::infinity()) {}

bool ImpactWatch::link_went_along(const Sample& oldest, const Sample& now) const noexcept {
  const double apart_rad = (now.position_rad - oldest.position_rad) -
                           (now.link_position_rad - oldest.link_position_rad);
  return std::abs(apart_rad) < kWentAlong_rad;  // false for NaN
}

bool ImpactWatch::pushed_there(const Sample& now) noexcept {
  held_ = std::abs(now.position_rad - held_at_rad_) < kStays_rad;
  if (std::abs(now.torque_Nm) < kPushesShare * limit_Nm_) pushed_us_ = last_us_;
  return held_ && last_us_ - pushed_us_ >= kStays_us;
}

void ImpactWatch::add(const Sample& sample, std::int64_t sync_us) noexcept {
  if (hit_) return;
  if (sync_us - last_us_ != cycle_us_) known_ = 0;
  last_us_ = sync_us;
  if (held_) hit_ = pushed_there(sample);
  const int size = 3 * span_ + 1;
  const auto before = [&](int spans) -> const Sample& {
    const int place = next_ - spans * span_;
    return samples_[static_cast<std::size_t>(place < 0 ? place + size : place)];
  };
  samples_[static_cast<std::size_t>(next_)] = sample;
  known_ = std::min(known_ + 1, size);
  if (known_ == size && !held_ && !hit_) {
    change_rad_s_ = (sample.position_rad - before(1).position_rad - before(2).position_rad +
                     before(3).position_rad) /
                    span_s_;
    const bool hard = std::abs(change_rad_s_) > most_rad_s_;
    held_ = hard && link_went_along(before(3), sample);
    hit_ = hard && !held_;
    held_at_rad_ = sample.position_rad;
    pushed_us_ = sync_us;
  }
  next_ = next_ + 1 == size ? 0 : next_ + 1;
}

}  // namespace sprung
