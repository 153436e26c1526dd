#include "controller/gain_ramp.h"

#include <algorithm>
#include <cmath>

namespace sprung {

std::array<double*, GainRamp::kGains> GainRamp::gains_of(DesiredLeg& d) noexcept {
  return {&d.stiffness_N_m[0],      &d.stiffness_N_m[1],     &d.stiffness_N_m[2],
          &d.damping_N_s_m[0],      &d.damping_N_s_m[1],     &d.damping_N_s_m[2],
          &d.friction_compensation, &d.inertia_compensation, &d.velocity_feedforward};
}

void GainRamp::start(const DesiredLeg& desired) noexcept {
  DesiredLeg copy = desired;
  const auto wanted = gains_of(copy);
  for (std::size_t i = 0; i < gains_.size(); ++i) gains_[i] = {*wanted[i], *wanted[i], 0.0};
}

void GainRamp::advance(double dt_s, DesiredLeg& desired) noexcept {
  if (ramp_s_ <= 0.0) return;
  const auto wanted = gains_of(desired);
  for (std::size_t i = 0; i < gains_.size(); ++i) {
    Gain& gain = gains_[i];
    if (*wanted[i] != gain.wanted) {
      gain.wanted = *wanted[i];
      gain.rate_1_s = std::max(std::abs(gain.acting), std::abs(gain.wanted)) / ramp_s_;
    }
    const double step = gain.rate_1_s * dt_s;
    gain.acting = std::clamp(gain.wanted, gain.acting - step, gain.acting + step);
    *wanted[i] = gain.acting;
  }
}

}  // namespace sprung
