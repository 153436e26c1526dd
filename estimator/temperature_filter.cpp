#include "estimator/temperature_filter.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// What heat and cooling do besides the model: 1 K in a minute.
constexpr double kWalk_K_sqrt_s = 0.13;
/// Of friction seen once: 2 Nm of wrong weight, inertia and filter that stay for 0.1 s, as white noise of a
/// rate.
constexpr double kNoise_Nm2_s = 0.4;
/// Friction that differs by more is something that pushes the joint.
constexpr double kGateStds = 3.0;
constexpr double kGateLeast_Nm = 3.0;
constexpr double kColdest_C = -40.0, kHottest_C = 120.0;
constexpr double kDifference_K = 0.5;

}  // namespace

void TemperatureFilter::reset() noexcept {
  state_.reset(thermal_.ambient_C);
  variance_K2_ = thermal_.ambient_std_K * thermal_.ambient_std_K;
}

void TemperatureFilter::predict(double friction_Nm, double velocity_rad_s, double dt_s) noexcept {
  if (!configured()) return;
  state_.step(friction_Nm * velocity_rad_s, dt_s);
  variance_K2_ += kWalk_K_sqrt_s * kWalk_K_sqrt_s * dt_s;
}

double TemperatureFilter::by_kelvin_Nm(const FrictionInput& at) const noexcept {
  FrictionInput warmer = at, colder = at;
  warmer.temperature_C = state_.temperature_C() + kDifference_K;
  colder.temperature_C = state_.temperature_C() - kDifference_K;
  return (friction_torque_Nm(law_, warmer) - friction_torque_Nm(law_, colder)) / (2.0 * kDifference_K);
}

void TemperatureFilter::observe(const FrictionInput& at, double excess_Nm, double dt_s) noexcept {
  if (!configured() || !std::isfinite(excess_Nm) || !(dt_s > 0.0)) return;
  const double by_kelvin = by_kelvin_Nm(at);
  const double room_Nm = kGateLeast_Nm + kGateStds * std::abs(by_kelvin) * std_K();
  if (by_kelvin == 0.0 || std::abs(excess_Nm) > room_Nm) return;
  const double gain = variance_K2_ * by_kelvin / (by_kelvin * by_kelvin * variance_K2_ + kNoise_Nm2_s / dt_s);
  state_.reset(std::clamp(state_.temperature_C() + gain * excess_Nm, kColdest_C, kHottest_C));
  variance_K2_ *= 1.0 - gain * by_kelvin;
}

double TemperatureFilter::std_K() const noexcept { return std::sqrt(variance_K2_); }

double TemperatureFilter::std_Nm(const FrictionInput& at) const noexcept {
  return configured() ? std::abs(by_kelvin_Nm(at)) * std_K() : 0.0;
}

}  // namespace sprung
