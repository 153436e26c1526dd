#include "simulation/node/profile_motion.h"

#include <algorithm>
#include <cmath>

namespace sprung::sim {

void ProfileMotion::enter(double counts, double velocity_counts_s) noexcept {
  reference_ = {counts, velocity_counts_s};
}

void ProfileMotion::turn_faster_or_slower(double target_counts_s, const ProfileLimits& limits,
                                          double dt_s) noexcept {
  double& speed = reference_.velocity_counts_s;
  const bool faster = std::abs(target_counts_s) > std::abs(speed) && target_counts_s * speed >= 0.0;
  const double most = dt_s * (faster ? limits.acceleration_counts_s2 : limits.deceleration_counts_s2);
  speed += std::clamp(target_counts_s - speed, -most, most);
}

PositionLoop::Reference ProfileMotion::to_position(double target_counts, const ProfileLimits& limits,
                                                   double dt_s) noexcept {
  const double left = target_counts - reference_.position_counts;
  // From this speed it stops just there, looking half a tick ahead: v^2 = 2 a s.
  const double ahead = std::max(std::abs(left) - 0.5 * std::abs(reference_.velocity_counts_s) * dt_s, 0.0);
  const double speed = std::min(std::sqrt(2.0 * limits.deceleration_counts_s2 * ahead),
                                limits.speed_counts_s);
  turn_faster_or_slower(std::copysign(speed, left), limits, dt_s);
  const double step = reference_.velocity_counts_s * dt_s;
  const double slow = 2.0 * limits.deceleration_counts_s2 * dt_s;
  if (std::abs(left) <= std::abs(step) && std::abs(reference_.velocity_counts_s) <= slow) {
    reference_ = {target_counts, 0.0};
  } else {
    reference_.position_counts += step;
  }
  return reference_;
}

PositionLoop::Reference ProfileMotion::to_velocity(double target_counts_s, const ProfileLimits& limits,
                                                   double dt_s) noexcept {
  const double wanted = std::clamp(target_counts_s, -limits.speed_counts_s, limits.speed_counts_s);
  turn_faster_or_slower(wanted, limits, dt_s);
  reference_.position_counts += reference_.velocity_counts_s * dt_s;
  return reference_;
}

}  // namespace sprung::sim
