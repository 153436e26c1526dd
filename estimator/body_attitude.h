#pragma once
/// Attitude and angular velocity of the trunk, from the best that there is in this cycle. Pure.
///
///   IMU with attitude   its quaternion; heading counts from the first sample.
///   IMU without         its rates, and gravity's direction where the specific force is as long as gravity.
///   no IMU              how the standing feet turn about their middle, and the plane through them, which is
///                       taken for level: a slope is not seen. What the feet cannot show stays as it is.
///
/// A change of source makes no jump: heading goes on, and a difference in tilt fades.
#include <Eigen/Geometry>

#include "estimator/imu_input.h"
#include "estimator/standing_feet.h"

namespace sprung {

class BodyAttitude {
 public:
  /// Forgets all but the heading, from which the next start goes on.
  void reset() noexcept;
  /// @param imu nullptr: none.
  void step(const ImuReading* imu, const StandingFeet& feet, double dt_s) noexcept;

  /// False until the first IMU sample, or until three feet have stood.
  bool known() const noexcept { return known_; }
  const Eigen::Quaterniond& trunk_to_world() const noexcept { return trunk_to_world_; }
  const Eigen::Vector3d& angular_velocity_rad_s() const noexcept { return angular_velocity_rad_s_; }

 private:
  void follow_imu(const ImuReading& imu, double dt_s) noexcept;
  void follow_rates(const ImuReading& imu, double dt_s) noexcept;
  void follow_feet(const StandingFeet& feet, double dt_s) noexcept;
  /// At the heading, turned by the least rotation to where `tilted` is.
  void start(const Eigen::Quaterniond& tilted) noexcept;

  bool known_ = false;
  bool follows_imu_ = false;
  double start_yaw_rad_ = 0.0;
  Eigen::Quaterniond trunk_to_world_ = Eigen::Quaterniond::Identity();
  /// From the world axes of the IMU to ours.
  Eigen::Quaterniond imu_to_world_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_rad_s_ = Eigen::Vector3d::Zero();
};

}  // namespace sprung
