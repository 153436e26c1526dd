#include "planner/ballistics.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

std::int64_t after(std::int64_t utime_us, double seconds) noexcept {
  return utime_us + std::llround(1e6 * seconds);
}

}  // namespace

double rise_m(double liftoff_length_m, double touchdown_length_m, double flight_s) noexcept {
  const double speed_m_s = (touchdown_length_m - liftoff_length_m) / flight_s +
                           0.5 * kGravity_m_s2 * flight_s;
  return speed_m_s > 0.0 ? speed_m_s * speed_m_s / (2.0 * kGravity_m_s2) : 0.0;
}

double rise_from_surface_m(double rise_m, double hip_over_leg_speed) noexcept {
  return rise_m * std::clamp(1.0 - kDentSlope * (hip_over_leg_speed - kFirmShare), 0.8, 1.2);
}

ExpectedTouchdown expected_touchdown(const LiftOff& lift_off, double touchdown_length_m) noexcept {
  const double up_m_s = std::max(0.0, lift_off.speed_m_s);
  const double squared = up_m_s * up_m_s + 2.0 * kGravity_m_s2 * (lift_off.length_m - touchdown_length_m);
  const double down_m_s = std::sqrt(std::max(0.0, squared));
  return {after(lift_off.utime_us, (up_m_s + down_m_s) / kGravity_m_s2), down_m_s};
}

ExpectedTouchdown fall_from_rest(std::int64_t now_us, double touchdown_in_s) noexcept {
  return {after(now_us, touchdown_in_s), kGravity_m_s2 * touchdown_in_s};
}

}  // namespace sprung
