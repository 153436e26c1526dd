#include "drivers/bridge/noisy_encoder_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprung {
namespace {

// All [design choice]: landings, pushes and stick-slip of every experiment stay below, docs/safety.md.
constexpr double kTimesTorque = 8.0;
constexpr double kNoiseQuanta = 8.0;
constexpr double kWindow_s = 0.02;
constexpr std::size_t kLeast = 4;

}  // namespace

NoisyEncoderWatch::NoisyEncoderWatch(double torque_limit_Nm, double inertia_kg_m2,
                                     double quantum_rad) noexcept
    : fastest_rad_s2_(inertia_kg_m2 > 0.0 ? kTimesTorque * torque_limit_Nm / inertia_kg_m2 : 0.0),
      quantum_rad_(quantum_rad) {}

void NoisyEncoderWatch::add(double position_rad, std::int64_t sync_us, std::int64_t cycle_us) noexcept {
  if (fastest_rad_s2_ <= 0.0) return;
  if (known_ > 0 && sync_us - last_us_ != cycle_us) known_ = 0;
  last_us_ = sync_us;
  if (known_ == 2) judge(position_rad - 2.0 * before_rad_[0] + before_rad_[1], cycle_us);
  before_rad_ = {position_rad, before_rad_[0]};
  known_ = std::min(known_ + 1, 2);
}

void NoisyEncoderWatch::judge(double difference_rad, std::int64_t cycle_us) noexcept {
  const double cycle_s = 1e-6 * static_cast<double>(cycle_us);
  const auto window = std::min(kMost, static_cast<std::size_t>(std::lround(kWindow_s / cycle_s)));
  difference_[next_] = difference_rad;
  next_ = (next_ + 1) % window;
  filled_ = std::min(filled_ + 1, window);
  const double most_rad = std::max(fastest_rad_s2_ * cycle_s * cycle_s, kNoiseQuanta * quantum_rad_);
  const auto beyond = static_cast<std::size_t>(
      std::count_if(difference_.begin(), difference_.begin() + static_cast<std::ptrdiff_t>(filled_),
                    [&](double d) { return std::abs(d) > most_rad; }));
  noisy_ = noisy_ || (beyond >= kLeast && 3 * beyond >= window);
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
  next_ = filled_ = 0;
  noisy_ = false;
}

}  // namespace sprung
