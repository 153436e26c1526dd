#include "estimator/imu_mounting.h"

#include <algorithm>

#include "estimator/rotation.h"

namespace sprung {
namespace {

constexpr double kPriorTilt_rad = 0.012, kPriorSlope = 0.2;  // [design choice] a degree at most; a ramp
/// [design choice] Of ground and encoders, between two feet.
constexpr double kFootprint_m = 0.009;
constexpr double kSlopeWalk = 0.001;      // [design choice] from one footprint to the next
constexpr double kLegsFeign_rad = 0.003;  // 2 mm of 0.65 m
constexpr double kOtherGround = 12.0;     // of one number, squared, over its variance: once in 2000 times
constexpr double kMostTilt_rad = 0.05;    // more is no mounting
/// Weight from which a foot has come to stand, and below which it has left.
constexpr double kCameDown = 0.7, kLeft = 0.3;

}  // namespace

ImuMounting::ImuMounting() noexcept : covariance_(Eigen::Matrix4d::Zero()) {
  covariance_.diagonal().head<2>().setConstant(kPriorSlope * kPriorSlope);
  covariance_.diagonal().tail<2>().setConstant(kPriorTilt_rad * kPriorTilt_rad);
}

Eigen::Quaterniond ImuMounting::sensor_to_trunk() const noexcept {
  return turned_by({tilt_rad_.x(), tilt_rad_.y(), 0.0});
}

Eigen::Matrix2d ImuMounting::covariance_rad2() const noexcept {
  return covariance_.bottomRightCorner<2, 2>() +
         kLegsFeign_rad * kLegsFeign_rad * Eigen::Matrix2d::Identity();
}

void ImuMounting::step(const Eigen::Quaterniond& trunk_to_world, const StandingFeet& feet) noexcept {
  const int legs = std::min(kLegs, static_cast<int>(feet.feet().size()));
  const std::array<bool, kLegs> before = stood_;
  for (std::size_t i = 0; i < static_cast<std::size_t>(legs); ++i)
    stood_[i] = feet.feet()[i].weight > (before[i] ? kLeft : kCameDown);
  for (std::size_t i = 0; i < static_cast<std::size_t>(legs); ++i) {
    if (!stood_[i] || before[i]) continue;
    covariance_.diagonal().head<2>().array() += kSlopeWalk * kSlopeWalk;
    const auto compares = [&](std::size_t j) { return stood_[j] && (before[j] || j < i); };
    int others = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(legs); ++j) others += j != i && compares(j) ? 1 : 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(legs); ++j)
      if (j != i && compares(j))
        compare(trunk_to_world, feet.feet()[i].in_trunk_m - feet.feet()[j].in_trunk_m, others);
  }
}

/// What all others say of one foot has that foot's error in common.
void ImuMounting::compare(const Eigen::Quaterniond& trunk_to_world, const Eigen::Vector3d& apart_in_trunk_m,
                          int others) noexcept {
  const Eigen::Vector3d apart_m = trunk_to_world * apart_in_trunk_m;
  const Eigen::Vector3d up_in_trunk = trunk_to_world.conjugate() * Eigen::Vector3d::UnitZ();
  Eigen::Vector4d by;
  by << apart_m.head<2>(), apart_in_trunk_m.cross(up_in_trunk).head<2>();
  const double surprise_m = apart_m.z() - slope_.dot(apart_m.head<2>());
  const double noise_m2 = kFootprint_m * kFootprint_m * others;
  if (surprise_m * surprise_m > kOtherGround * (by.dot(covariance_ * by) + noise_m2)) {
    covariance_.topRows<2>().setZero();
    covariance_.leftCols<2>().setZero();
    covariance_.diagonal().head<2>().setConstant(kPriorSlope * kPriorSlope);
  }
  const Eigen::Vector4d seen = covariance_ * by;
  const Eigen::Vector4d gain = seen / (by.dot(seen) + noise_m2);
  slope_ += surprise_m * gain.head<2>();
  tilt_rad_ += surprise_m * gain.tail<2>();
  tilt_rad_ = tilt_rad_.cwiseMax(-kMostTilt_rad).cwiseMin(kMostTilt_rad);
  covariance_ -= gain * seen.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

}  // namespace sprung
