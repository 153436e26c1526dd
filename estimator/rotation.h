#pragma once
/// Rotations of the trunk: quaternions that turn trunk axes into world axes (z up).
#include <Eigen/Geometry>
#include <cmath>

namespace sprung {

/// Rotation by a vector: its direction is the axis, its length the angle.
inline Eigen::Quaterniond turned_by(const Eigen::Vector3d& rotation_rad) noexcept {
  const double angle_rad = rotation_rad.norm();
  if (angle_rad < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, rotation_rad / angle_rad));
}

/// Heading: of trunk x, seen from above, from world x; positive to the left.
inline double yaw_rad(const Eigen::Quaterniond& q) noexcept {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

/// Angle between trunk z and world z.
inline double tilt_rad(const Eigen::Quaterniond& q) noexcept {
  return 2.0 * std::atan2(std::hypot(q.x(), q.y()), std::hypot(q.w(), q.z()));
}

inline Eigen::Quaterniond turned_about_z(double angle_rad) noexcept {
  return Eigen::Quaterniond(std::cos(0.5 * angle_rad), 0.0, 0.0, std::sin(0.5 * angle_rad));
}

}  // namespace sprung
