#include "estimator/contact_detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {

ContactDetector::ContactDetector(const ContactParams& params) : params_(params) {
  if (!(params.on_N > params.off_N)) throw std::invalid_argument("contact: 'on' must be above 'off'");
  if (!(params.rise_s >= 0.0 && params.fall_s >= 0.0)) {
    throw std::invalid_argument("contact: delays must not be negative");
  }
}

void ContactDetector::reset() noexcept {
  contact_ = false;
  beyond_s_ = 0.0;
}

ContactEstimate ContactDetector::step(double vertical_force_N, double force_bound_N, double dt_s) noexcept {
  if (!std::isfinite(vertical_force_N) || !std::isfinite(force_bound_N)) {
    reset();
    return {};
  }
  const bool beyond =
      contact_ ? vertical_force_N < params_.off_N : vertical_force_N - force_bound_N > params_.on_N;
  const double delay_s = contact_ ? params_.fall_s : params_.rise_s;
  constexpr double kRounding_s = 1e-9;  // message times are whole microseconds
  // The sample that crosses starts the clock, so that a delay of n cycles takes n more samples.
  const double lasted_s = beyond_s_;
  if (beyond && lasted_s + kRounding_s >= delay_s) {
    contact_ = !contact_;
    beyond_s_ = 0.0;
  } else {
    beyond_s_ = beyond ? beyond_s_ + dt_s : 0.0;
  }
  const double middle_N = 0.5 * (params_.on_N + params_.off_N);
  const double spread_N = std::max(0.5 * (params_.on_N - params_.off_N), force_bound_N);
  return {contact_, 0.5 * (1.0 + std::tanh((vertical_force_N - middle_N) / spread_N))};
}

}  // namespace sprung
