#pragma once
/// Velocity and height of the trunk over the feet that stand. Pure.
///
/// A Kalman filter whose noise has no direction, so that its variance is one number: specific force moves the
/// velocity (without an IMU it is taken to go on as it is), each standing foot says -(its velocity) - w x
/// (its place). A foot that disagrees by much, as one that slides, counts less. The height follows the
/// vertical velocity and is held by the standing feet. In flight both go on for a while, and are then
/// unknown.
#include <Eigen/Geometry>

#include "estimator/imu_input.h"
#include "estimator/standing_feet.h"

namespace sprung {

class BodyMotion {
 public:
  void reset() noexcept;
  struct Attitude {
    Eigen::Quaterniond trunk_to_world;
    Eigen::Vector3d angular_velocity_rad_s;  ///< trunk axes
  };
  /// @param imu nullptr: none.
  void step(const ImuReading* imu, const Attitude& attitude, const StandingFeet& feet, double dt_s) noexcept;

  /// False until a foot stands, and when none has stood for half a second.
  bool known() const noexcept { return known_; }
  const Eigen::Vector3d& velocity_m_s() const noexcept {
    return velocity_m_s_;
  }  ///< of the trunk's origin, trunk axes
  double height_m() const noexcept { return height_m_; }

 private:
  void start(const Attitude& attitude, const StandingFeet& feet) noexcept;
  void predict(const ImuReading* imu, const Attitude& attitude, double dt_s) noexcept;
  void correct(const StandingFoot& foot, const Eigen::Vector3d& angular_velocity_rad_s, double dt_s) noexcept;
  void follow_height(const Attitude& attitude, const StandingFeet& feet, double dt_s) noexcept;

  bool known_ = false;
  double in_flight_s_ = 0.0;
  double variance_m2_s2_ = 0.0;  ///< of each axis
  Eigen::Vector3d velocity_m_s_ = Eigen::Vector3d::Zero();
  double height_m_ = 0.0;
};

}  // namespace sprung
