#include "drivers/bridge/noisy_encoder_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "signals/microseconds.h"

namespace sprung {
namespace {

// All [design choice]: landings, pushes and stick-slip of every experiment stay below, docs/safety.md.
constexpr double kTimesTorque = 8.0;
constexpr double kNoiseQuanta = 8.0;
constexpr double kWindow_s = 0.02;
constexpr std::size_t kLeast = 4;

}  // namespace

NoisyEncoderWatch::NoisyEncoderWatch(double torque_limit_Nm, double inertia_kg_m2, double quantum_rad,
                                     double cycle_s) noexcept
    : most_rad_(0.0),
      window_(std::min(kMost, static_cast<std::size_t>(std::lround(kWindow_s / cycle_s)))),
      cycle_us_(to_us(cycle_s)) {
  if (inertia_kg_m2 <= 0.0) return;
  const double fastest_rad_s2 = kTimesTorque * torque_limit_Nm / inertia_kg_m2;
  most_rad_ = std::max(fastest_rad_s2 * cycle_s * cycle_s, kNoiseQuanta * quantum_rad);
}

void NoisyEncoderWatch::add(double position_rad, std::int64_t sync_us) noexcept {
  if (most_rad_ <= 0.0) return;
  if (known_ > 0 && sync_us - last_us_ != cycle_us_) known_ = 0;
  last_us_ = sync_us;
  if (known_ == 2) judge(position_rad - 2.0 * before_rad_[0] + before_rad_[1]);
  before_rad_ = {position_rad, before_rad_[0]};
  known_ = std::min(known_ + 1, 2);
}

void NoisyEncoderWatch::judge(double difference_rad) noexcept {
  if (filled_ == window_ && is_jitter(difference_[next_])) --beyond_;
  if (is_jitter(difference_rad)) ++beyond_;
  difference_[next_] = difference_rad;
  next_ = next_ + 1 == window_ ? 0 : next_ + 1;
  filled_ = std::min(filled_ + 1, window_);
  noisy_ = noisy_ || (beyond_ >= kLeast && 3 * beyond_ >= window_);
}

/// White noise has second differences of sqrt(6) times its own size.
double NoisyEncoderWatch::noise_rad() const noexcept {
  if (filled_ == 0) return 0.0;
  const double sum = std::inner_product(difference_.begin(),
                                        difference_.begin() + static_cast<std::ptrdiff_t>(filled_),
                                        difference_.begin(), 0.0);
  return std::sqrt(sum / (6.0 * static_cast<double>(filled_)));
}

void NoisyEncoderWatch::forget() noexcept {
  known_ = 0;
  next_ = filled_ = beyond_ = 0;
  noisy_ = false;
}

}  // namespace sprung
