#pragma once
/// How far the IMU is tilted against the trunk, learned while the robot turns. Pure: no heap.
///
/// A robot that goes straight cannot tell an IMU that is mounted askew from ground that slopes. One that
/// turns can: the slope turns below it, the IMU turns with it. Each foot that comes to stand says by how much
/// it is higher than the others that stand, by encoders and the IMU's tilt; a Kalman filter of the slope,
/// which changes, and the tilt, which does not, shares that between both. A footprint that surprises is
/// another ground: the slope begins anew, the tilt stays as sure as it was.
///
/// Legs and zeros that lean all to one side look the same as an IMU that does, and are taken for it. What it
/// is turned about the vertical nobody sees: it only mixes roll and pitch, by a hundredth or two.
#include <Eigen/Geometry>
#include <array>

#include "estimator/standing_feet.h"

namespace sprung {

class ImuMounting {
 public:
  ImuMounting() noexcept;

  /// Call once a cycle with the attitude as the IMU shows it, corrected by tilt_rad().
  void step(const Eigen::Quaterniond& trunk_to_world, const StandingFeet& feet) noexcept;

  /// About trunk x and y, from trunk axes to the sensor's.
  const Eigen::Vector2d& tilt_rad() const noexcept { return tilt_rad_; }
  /// What the sensor measures, times this, is in trunk axes.
  Eigen::Quaterniond sensor_to_trunk() const noexcept;
  /// Of tilt_rad, with what legs feign.
  Eigen::Matrix2d covariance_rad2() const noexcept;

 private:
  static constexpr int kLegs = 4;  ///< more are not looked at

  void compare(const Eigen::Quaterniond& trunk_to_world, const Eigen::Vector3d& apart_in_trunk_m,
               int others) noexcept;

  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();  ///< rise over run along world x and y
  Eigen::Vector2d tilt_rad_ = Eigen::Vector2d::Zero();
  Eigen::Matrix4d covariance_;  ///< slope, tilt
  std::array<bool, kLegs> stood_{};
};

}  // namespace sprung
