#include "planner/joint_move.h"

#include <algorithm>
#include <cmath>

namespace sprung {

JointMove::JointMove(double from_rad, double to_rad, double speed_rad_s, double acceleration_rad_s2) noexcept
    : from_rad_(from_rad), to_rad_(to_rad) {
  const double way_rad = to_rad - from_rad;
  const double length_rad = std::abs(way_rad);
  const double peak_rad_s = std::min(speed_rad_s, std::sqrt(acceleration_rad_s2 * length_rad));
  if (!(peak_rad_s > 0.0)) return;
  rising_s_ = falling_s_ = peak_rad_s / acceleration_rad_s2;
  steady_s_ = std::max(0.0, length_rad / peak_rad_s - rising_s_);
  acceleration_rad_s2_ = std::copysign(acceleration_rad_s2, way_rad);
  peak_rad_s_ = std::copysign(peak_rad_s, way_rad);
}

JointPoint JointMove::at(double time_s) const noexcept {
  if (!(time_s < duration_s())) return {to_rad_, 0.0};
  if (time_s < 0.0) return {from_rad_, 0.0};
  if (time_s < rising_s_) {
    const double velocity_rad_s = acceleration_rad_s2_ * time_s;
    return {from_rad_ + 0.5 * velocity_rad_s * time_s, velocity_rad_s};
  }
  const double left_s = duration_s() - time_s;
  if (left_s > falling_s_) return {from_rad_ + peak_rad_s_ * (time_s - 0.5 * rising_s_), peak_rad_s_};
  const double velocity_rad_s = acceleration_rad_s2_ * left_s;
  return {to_rad_ - 0.5 * velocity_rad_s * left_s, velocity_rad_s};
}

JointMove JointMove::braked(double time_s) const noexcept {
  const JointPoint now = at(time_s);
  JointMove out(now.position_rad);
  if (now.velocity_rad_s == 0.0) return out;
  out.acceleration_rad_s2_ = acceleration_rad_s2_;
  out.peak_rad_s_ = now.velocity_rad_s;
  out.falling_s_ = now.velocity_rad_s / acceleration_rad_s2_;
  out.to_rad_ = now.position_rad + 0.5 * now.velocity_rad_s * out.falling_s_;
  return out;
}

}  // namespace sprung
