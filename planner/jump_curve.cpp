#include "planner/jump_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kSameLength_m = 1e-6;
constexpr int kSearchSteps = 200;  // for the longest leg: a millisecond of a 0.2 s curve

/// Control points above the crouch (first half) or the landing length (second).
std::vector<double> excess(const PresetConfig& preset) {
  std::vector<double> points = preset.jump_curve.lengths_m;
  const std::size_t first_half = (points.size() + 1) / 2;
  const double crouch = preset.jump_curve.lengths_m.empty() ? 0.0 : preset.jump_curve.lengths_m.front();
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] -= i < first_half ? crouch : preset.landing_length_m;
  return points;
}

}  // namespace

JumpCurve::JumpCurve(const PresetConfig& preset)
    : at_unit_(preset.jump_curve.lengths_m, preset.jump_curve.duration_s),
      excess_(excess(preset), preset.jump_curve.duration_s),
      push_({kForwardPush.begin(), kForwardPush.end()}, preset.jump_curve.duration_s),
      ahead_({kForwardLanding.begin(), kForwardLanding.end()}, preset.jump_curve.duration_s),
      crouch_length_m_(preset.jump_curve.lengths_m.front()) {
  if (std::abs(at_unit_.end() - preset.landing_length_m) > kSameLength_m) {
    throw std::invalid_argument("preset '" + preset.name + "': jump_curve must end at landing_length");
  }
  scale(1.0);
}

void JumpCurve::scale(double factor) noexcept {
  factor_ = factor;
  longest_m_ = crouch_length_m_;
  for (int i = 0; i <= kSearchSteps; ++i) {
    longest_m_ = std::max(longest_m_, -at(duration_s() * i / kSearchSteps).position_m[2]);
  }
}

void JumpCurve::forward(double distance_m, double flight_s) noexcept {
  ahead_m_ = kForwardAhead * distance_m;
  const double speed_m_s = (1.0 - kForwardAhead) * distance_m / flight_s;
  push_m_ = speed_m_s * duration_s() / kForwardSlope;
}

FootPoint JumpCurve::at(double time_s) const noexcept {
  const CurvePoint unit = at_unit_.at(time_s);
  const CurvePoint extra = excess_.at(time_s);
  const double more = factor_ - 1.0;
  const CurvePoint push = push_.at(time_s);
  const CurvePoint ahead = ahead_.at(time_s);
  FootPoint out;
  out.position_m = {push_m_ * push.value + ahead_m_ * ahead.value, 0.0, -(unit.value + more * extra.value)};
  out.velocity_m_s = {push_m_ * push.rate_1_s + ahead_m_ * ahead.rate_1_s, 0.0,
                      -(unit.rate_1_s + more * extra.rate_1_s)};
  out.acceleration_m_s2 = {push_m_ * push.acceleration_1_s2 + ahead_m_ * ahead.acceleration_1_s2, 0.0,
                           -(unit.acceleration_1_s2 + more * extra.acceleration_1_s2)};
  return out;
}

}  // namespace sprung
