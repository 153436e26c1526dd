#include "estimator/body_attitude.h"

#include <algorithm>
#include <cmath>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"

namespace sprung {
namespace {

/// In which the tilt by which an IMU that has come back differs from the estimate fades.
constexpr double kFading_s = 0.2;
/// Over which an IMU's own attitude and its rates are mixed. Without, 0.7 mrad of noise are 0.4 mm at a foot,
/// and its position loop, which takes a set-point's rate for wanted speed, answers with 10 Nm from cycle to
/// cycle. 2 mrad/s of bias lag by 0.1 mrad.
constexpr double kImuSmoothing_s = 0.05;
/// Gravity holds the gyro's drift: 2 mrad/s of bias leave 2 mrad, and a push of 0.1 s at 1 m/s^2 moves it
/// by 10.
constexpr double kGravityHolds_s = 1.0;
/// A specific force whose length differs by more is not gravity alone.
constexpr double kGravityError_m_s2 = 1.0;
/// Of the feet: velocities of joints are good to 0.01 rad/s, so that a trunk's rate needs little smoothing.
constexpr double kRateSmoothing_s = 0.01;
/// With no foot on the ground nothing shows whether the trunk still turns.
constexpr double kRateForgotten_s = 0.1;
/// The plane through the feet holds the drift of the rate that they show.
constexpr double kPlaneHolds_s = 0.05;
constexpr int kFeetOfAPlane = 3;
constexpr int kPlaneIterations = 6;  ///< from 0.6 rad to below 1e-6

double share(double dt_s, double time_s) noexcept { return 1.0 - std::exp(-dt_s / time_s); }

/// The part of a rotation about z alone.
Eigen::Quaterniond about_z(const Eigen::Quaterniond& q) noexcept {
  const double length = std::hypot(q.w(), q.z());
  if (length < 1e-9) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(q.w() / length, 0.0, 0.0, q.z() / length);
}

}  // namespace

void BodyAttitude::reset() noexcept {
  if (known_) start_yaw_rad_ = yaw_rad(trunk_to_world_);
  known_ = false;
  follows_imu_ = false;
  angular_velocity_rad_s_.setZero();
}

void BodyAttitude::step(const ImuReading* imu, const StandingFeet& feet, double dt_s) noexcept {
  if (imu == nullptr) {
    follow_feet(feet, dt_s);
  } else if (imu->has_attitude) {
    follow_imu(*imu, dt_s);
  } else {
    follow_rates(*imu, dt_s);
  }
  follows_imu_ = imu != nullptr && imu->has_attitude;
  trunk_to_world_.normalize();
}

void BodyAttitude::start(const Eigen::Quaterniond& tilted) noexcept {
  trunk_to_world_ = turned_about_z(start_yaw_rad_ - yaw_rad(tilted)) * tilted;
  known_ = true;
}

void BodyAttitude::follow_imu(const ImuReading& imu, double dt_s) noexcept {
  angular_velocity_rad_s_ = imu.angular_velocity_rad_s;
  if (!known_) {
    start(imu.attitude);
    imu_to_world_ = about_z(trunk_to_world_ * imu.attitude.conjugate());
    trunk_to_world_ = imu_to_world_ * imu.attitude;
    return;
  }
  const Eigen::Quaterniond goes_on = trunk_to_world_ * turned_by(dt_s * angular_velocity_rad_s_);
  if (!follows_imu_) {
    imu_to_world_ = goes_on * imu.attitude.conjugate();
    trunk_to_world_ = goes_on;
    return;
  }
  const Eigen::Quaterniond heading = about_z(imu_to_world_);
  imu_to_world_ = heading.slerp(std::exp(-dt_s / kFading_s), imu_to_world_).normalized();
  trunk_to_world_ = goes_on.slerp(share(dt_s, kImuSmoothing_s), imu_to_world_ * imu.attitude);
}

void BodyAttitude::follow_rates(const ImuReading& imu, double dt_s) noexcept {
  angular_velocity_rad_s_ = imu.angular_velocity_rad_s;
  const double length_m_s2 = imu.specific_force_m_s2.norm();
  const double trust = std::max(0.0, 1.0 - std::abs(length_m_s2 - kGravity_m_s2) / kGravityError_m_s2);
  if (!known_ && trust <= 0.0) return;
  if (!known_)
    return start(Eigen::Quaterniond::FromTwoVectors(imu.specific_force_m_s2, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d up = trunk_to_world_.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d error = trust > 0.0 ? Eigen::Vector3d(imu.specific_force_m_s2.cross(up) / length_m_s2)
                                            : Eigen::Vector3d::Zero();
  const Eigen::Vector3d turn = angular_velocity_rad_s_ + trust / kGravityHolds_s * error;
  trunk_to_world_ = trunk_to_world_ * turned_by(dt_s * turn);
}

void BodyAttitude::follow_feet(const StandingFeet& feet, double dt_s) noexcept {
  const double smoothing_s = feet.weight() > 0.0 ? kRateSmoothing_s : kRateForgotten_s;
  angular_velocity_rad_s_ += share(dt_s, smoothing_s) *
                             (feet.angular_velocity_rad_s() - angular_velocity_rad_s_);
  if (known_) {
    trunk_to_world_ = trunk_to_world_ * turned_by(dt_s * angular_velocity_rad_s_);
    const Eigen::Vector3d error_rad = feet.tilt_error_rad(trunk_to_world_);
    trunk_to_world_ = turned_by(share(dt_s, kPlaneHolds_s) * error_rad) * trunk_to_world_;
  } else if (feet.count() >= kFeetOfAPlane) {
    Eigen::Quaterniond plane = Eigen::Quaterniond::Identity();
    for (int i = 0; i < kPlaneIterations; ++i) plane = turned_by(feet.tilt_error_rad(plane)) * plane;
    start(plane);
  }
}

}  // namespace sprung
