#include "planner/gait/gait_clock.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kNever_s = 1e3;

double wrapped(double phase) noexcept { return phase - std::floor(phase); }

}  // namespace

double GaitClock::since_offset(std::size_t leg, double phase) const noexcept {
  return wrapped(phase - gait_->offsets[leg]);
}

void GaitClock::begin(const GaitConfig& gait, std::size_t legs) noexcept {
  gait_ = &gait;
  legs_ = legs;
  holding_ = false;
  swinging_.fill(false);
  steps_.fill(0);
  const double first = *std::min_element(gait.offsets.begin(), gait.offsets.end());
  double before = 1.0;  // share of the period for which all feet have stood when the first one leaves
  for (std::size_t i = 0; i < legs; ++i)
    before = std::min(before, std::max(0.0, wrapped(first - gait.offsets[i] - 1e-9) - (1.0 - gait.duty)));
  phase_ = wrapped(first - before);
}

void GaitClock::advance(double dt_s) noexcept {
  const double step = dt_s / gait_->period_s;
  const double next = phase_ + step;
  for (std::size_t i = 0; i < legs_; ++i) {
    const double to_go = wrapped(gait_->offsets[i] - phase_);
    const bool due = gait_->duty < 1.0 && step > 0.0 && (to_go < step || to_go == 0.0);
    if (!due || holding_ || swinging_[i]) continue;
    swinging_[i] = true;
    ++steps_[i];
  }
  phase_ = wrapped(next);
}

double GaitClock::swing_share(std::size_t leg) const noexcept {
  return std::min(1.0, since_offset(leg, phase_) / (1.0 - gait_->duty));
}

double GaitClock::until_swing_s(std::size_t leg) const noexcept {
  if (holding_ || gait_->duty >= 1.0) return kNever_s;
  return wrapped(gait_->offsets[leg] - phase_) * gait_->period_s;
}

bool GaitClock::all_stand() const noexcept {
  return std::none_of(swinging_.begin(), swinging_.begin() + static_cast<std::ptrdiff_t>(legs_),
                      [](bool swings) { return swings; });
}

void GaitClock::count_anew() noexcept {
  for (std::size_t i = 0; i < legs_; ++i) steps_[i] = swinging_[i] ? 1 : 0;
}

int GaitClock::rounds() const noexcept {
  return *std::min_element(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(legs_));
}

}  // namespace sprung
