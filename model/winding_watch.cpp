#include "model/winding_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung {
namespace {

constexpr double kWarm = 1.0;
constexpr double kLately_s = 10.0;  // [design choice] longer than a crawl's round
constexpr double kCooled = 0.95;    // [design choice] as simulated drives release

}  // namespace

void WindingWatch::add(double measured_current_A, std::int64_t time_us) noexcept {
  if (time_constant_s_ <= 0.0 || rated_A_ <= 0.0) return;
  const double dt_s = last_us_ < 0 ? 0.0 : 1e-6 * static_cast<double>(time_us - last_us_);
  if (std::isfinite(measured_current_A)) last_A_ = measured_current_A;
  last_us_ = time_us;
  const double load = last_A_ * last_A_ / (rated_A_ * rated_A_);
  warmth_ += (load - warmth_) * std::clamp(dt_s / time_constant_s_, 0.0, 1.0);
  seen_s_ = std::min(kLately_s, seen_s_ + dt_s);
  if (seen_s_ > 0.0) load_ += (load - load_) * std::clamp(dt_s / seen_s_, 0.0, 1.0);
  warm_ = warmth_ >= kWarm || (warm_ && warmth_ > kCooled);
}

double WindingWatch::warm_in_s() const noexcept {
  if (warmth_ >= kWarm) return 0.0;
  if (time_constant_s_ <= 0.0 || load_ <= kWarm) return std::numeric_limits<double>::quiet_NaN();
  return time_constant_s_ * std::log((load_ - warmth_) / (load_ - kWarm));
}

}  // namespace sprung
