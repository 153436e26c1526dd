#pragma once
/// A hip in free flight over level ground: it rises from the leg's length at lift-off and meets the ground
/// with the leg's length at touchdown. Pure.
#include <cstdint>

#include "model/leg_kinematics.h"

namespace sprung {

/// What is known when flight begins.
struct ExpectedTouchdown {
  std::int64_t utime_us = 0;      ///< when; an estimate from lift-off, or what the operator said
  double approach_speed_m_s = 0;  ///< of the hip, downward, then
};

/// Lift-off as measured: hip's speed upward is the leg's extension speed while the foot still stands.
struct LiftOff {
  std::int64_t utime_us = 0;
  double length_m = 0.0;
  double speed_m_s = 0.0;
};

/// Rise of the hip above its height at lift-off (docs/sources.md, errata E11), by v = (L1 - L0) / t + g t / 2
/// and h = v^2 / (2 g); 0 where v is not upward. @param flight_s > 0.
double rise_m(double liftoff_length_m, double touchdown_length_m, double flight_s) noexcept;

/// From the rise since the ground's force was gone to the rise since the foot left its undented surface,
/// which is what jumps are measured by. Soft ground is dented for longer, and throws the hip up faster than
/// the leg extends: share of that speed. Measured on 5 to 60 kN/m, within 7 % at 150 to 200 mm
/// (docs/control.md).
inline constexpr double kFirmShare = 0.90;
inline constexpr double kDentSlope = 0.6;
double rise_from_surface_m(double rise_m, double hip_over_leg_speed) noexcept;

/// Where the hip does not rise to the touchdown length, the top of its path.
ExpectedTouchdown expected_touchdown(const LiftOff& lift_off, double touchdown_length_m) noexcept;

/// Of a fall from rest that begins now.
ExpectedTouchdown fall_from_rest(std::int64_t now_us, double touchdown_in_s) noexcept;

}  // namespace sprung
