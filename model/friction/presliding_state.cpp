#include "model/friction/presliding_state.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Angles at which the elements slip, in units of presliding_rad: octaves, scaled so that the mean of 1 /
/// angle (the first stiffness) is 1.
constexpr std::array<double, 4> kAngles = {0.46875, 0.9375, 1.875, 3.75};

}  // namespace

void PreslidingState::reset(double position_rad, double sign) noexcept {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i] = {position_rad - sign * kAngles[i] * presliding_rad_, -sign * kAngles[i], false};
  }
  position_rad_ = position_rad;
  sign_ = sign;
  by_presliding_1_rad_ = 0.0;
  unslipped_ = kElements;
  started_ = true;
}

double PreslidingState::step(double position_rad) noexcept {
  if (!started_) reset(position_rad);
  if (!(presliding_rad_ > 0.0)) {
    step_rigid(position_rad);
    return sign_;
  }
  double sum = 0.0, by_presliding = 0.0;
  unslipped_ = 0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    Element& e = elements_[i];
    const double angle_rad = kAngles[i] * presliding_rad_;
    double stretch = (position_rad - e.anchor_rad) / angle_rad;
    if (std::abs(stretch) >= 1.0) {
      stretch = stretch > 0.0 ? 1.0 : -1.0;
      e = {position_rad - stretch * angle_rad, -stretch * kAngles[i], true};
    }
    sum += stretch;
    by_presliding -= e.anchor_by_presliding / angle_rad + stretch / presliding_rad_;
    if (!e.slipped) ++unslipped_;
  }
  position_rad_ = position_rad;
  sign_ = sum / kElements;
  by_presliding_1_rad_ = by_presliding / kElements;
  return sign_;
}

void PreslidingState::step_rigid(double position_rad) noexcept {
  if (position_rad != position_rad_) {
    sign_ = position_rad > position_rad_ ? 1.0 : -1.0;
    unslipped_ = 0;
  }
  position_rad_ = position_rad;
}

}  // namespace sprung
