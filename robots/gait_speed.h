#pragma once
/// How much of what a gait can do a wanted speed asks for. Pure.
#include <array>
#include <cmath>
#include <limits>

#include "robots/gait_config.h"

namespace sprung {

/// The way that the sign of `forward` says: backward the legs swing differently.
inline double fastest_along_m_s(const GaitConfig& gait, double forward) noexcept {
  return forward < 0.0 ? gait.fastest_backward_m_s : gait.fastest_forward_m_s;
}

/// Root of the sum of the squared shares of the fastest forward or backward, sideways and turning: a gait's
/// steps serve all three, so that it goes each of its fastest only alone. Beyond 1 the gait does not go so.
/// NaN where a speed is.
/// @param speed forward, left m/s; turning rad/s.
inline double speed_share(const GaitConfig& gait, const std::array<double, 3>& speed) noexcept {
  const std::array<double, 3> fastest{fastest_along_m_s(gait, speed[0]), gait.fastest_sideways_m_s,
                                      gait.fastest_turning_rad_s};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (speed[i] == 0.0) continue;
    const double share = fastest[i] > 0.0 ? speed[i] / fastest[i]
                                          : std::numeric_limits<double>::infinity() * speed[i];
    sum += share * share;
  }
  return std::sqrt(sum);
}

/// How quickly a body that walks this gait may become faster, so that the foot whose first swing comes last,
/// within a period, is then no further behind than in every later step, half a stance. Sooner, that swing
/// takes speeds that the motors do not have. m/s^2, m/s^2, rad/s^2.
inline std::array<double, 3> starting_acceleration(const GaitConfig& gait) noexcept {
  const double rate_1_s = gait.duty / gait.period_s;
  return {rate_1_s * gait.fastest_forward_m_s, rate_1_s * gait.fastest_sideways_m_s,
          rate_1_s * gait.fastest_turning_rad_s};
}

inline constexpr double kMostSpeedShare = 1.0 + 1e-9;  ///< of rounding

}  // namespace sprung
