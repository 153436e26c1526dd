#include "simulation/node/motor_control.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung::sim {
namespace {

constexpr double kCapBand = 0.1;  ///< of the speed cap [design choice]

}  // namespace

void PositionLoop::enter(double measured_counts) noexcept {
  reference_counts_ = start_counts_ = measured_counts;
  if (!has_target_) target_counts_ = measured_counts;
  elapsed_s_ = early_s_ = length_s_ = 0.0;
}

void PositionLoop::set_target(double target_counts, double clock_s) noexcept {
  const bool clocked = clock_s > 0.0 && has_target_ && length_s_ > 0.0;
  early_s_ = clocked ? std::remainder(length_s_ - elapsed_s_, clock_s) : 0.0;
  start_counts_ = reference_counts_;
  target_counts_ = target_counts;
  has_target_ = true;
  elapsed_s_ = 0.0;
}

PositionLoop::Reference PositionLoop::step(double dt_s, double period_s, bool extrapolates) noexcept {
  length_s_ = period_s + early_s_;
  const double velocity_counts_s = (target_counts_ - start_counts_) / length_s_;
  // Half a tick of tolerance: sums of ticks are not exactly the period.
  const bool there = elapsed_s_ > length_s_ - 0.5 * dt_s;
  if (there && !extrapolates) return {target_counts_, 0.0};
  elapsed_s_ += dt_s;
  if (there) {
    reference_counts_ += velocity_counts_s * dt_s;
    return {reference_counts_, velocity_counts_s};
  }
  const double share = std::min(elapsed_s_ / length_s_, 1.0);
  reference_counts_ = start_counts_ + share * (target_counts_ - start_counts_);
  return {reference_counts_, velocity_counts_s};
}

CurrentLoop::CurrentLoop(double bandwidth_Hz, double dt_s) noexcept
    : share_(1.0 - std::exp(-kTurn_rad * bandwidth_Hz * dt_s)) {}

double CurrentLoop::step(double target_A) noexcept {
  current_A_ += share_ * (target_A - current_A_);
  return current_A_;
}

bool ThermalLimit::step(double current_A, double continuous_A, double time_constant_s, double dt_s) noexcept {
  if (continuous_A <= 0.0) return true;
  const double load = current_A / continuous_A;
  warmth_ += dt_s / time_constant_s * (load * load - warmth_);
  limits_ = warmth_ >= (limits_ ? kRelease : 1.0);
  return limits_;
}

double limit_torque(double torque, double limit, double velocity_rad_s, double speed_cap_rad_s) noexcept {
  const auto bound = [&](double speed) {
    const double room = (speed_cap_rad_s - speed) / (kCapBand * speed_cap_rad_s);
    return limit * std::clamp(room, -1.0, 1.0);
  };
  if (speed_cap_rad_s <= 0.0) return std::clamp(torque, -limit, limit);
  return std::clamp(torque, -bound(-velocity_rad_s), bound(velocity_rad_s));
}

}  // namespace sprung::sim
