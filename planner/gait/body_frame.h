#pragma once
/// Trunk, level and world axes. Level: z up, x along the trunk's heading, origin in the middle of the hips.
/// Pure.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace sprung {

struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< nose down is positive: rotation about y, left
  double yaw_rad = 0.0;
};

/// Of trunk axes in world axes: Rz(yaw) Ry(pitch) Rx(roll).
inline Attitude attitude(const std::array<double, 4>& wxyz) noexcept {
  const double w = wxyz[0], x = wxyz[1], y = wxyz[2], z = wxyz[3];
  return {std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
          std::asin(std::clamp(2.0 * (w * y - z * x), -1.0, 1.0)),
          std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))};
}

/// Turns trunk axes into level axes: Ry(pitch) Rx(roll).
inline Eigen::Matrix3d level_from_trunk(const Attitude& a) noexcept {
  const double sp = std::sin(a.pitch_rad), cp = std::cos(a.pitch_rad);
  const double sr = std::sin(a.roll_rad), cr = std::cos(a.roll_rad);
  Eigen::Matrix3d turned;
  turned << cp, sp * sr, sp * cr, 0.0, cr, -sr, -sp, cp * sr, cp * cr;
  return turned;
}

/// Of a trunk that lies along a plane, its heading kept. @param slope rise over way along x and y.
inline Attitude attitude_along(const Eigen::Vector2d& slope) noexcept {
  Attitude out;
  out.pitch_rad = -std::atan(slope.x());
  out.roll_rad = std::atan(slope.y() * std::cos(out.pitch_rad));
  return out;
}

inline double wrapped_rad(double angle_rad) noexcept { return std::remainder(angle_rad, 6.283185307179586); }

}  // namespace sprung
