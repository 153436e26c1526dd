#pragma once
/// The newest IMU sample that can be used, and how old it is. Pure.
#include <Eigen/Geometry>
#include <cstdint>

#include "estimator/imu_watch.h"
#include "signals/sensors.h"

namespace sprung {

/// A sample older than this counts as silence.
inline constexpr std::int64_t kOldestImu_cycles = 5;

struct ImuReading {
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();  ///< trunk axes
  Eigen::Vector3d specific_force_m_s2 = Eigen::Vector3d::Zero();
  /// Now: turned on by the rate for as long as it is old.
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  bool has_attitude = false;
};

class ImuInput {
 public:
  void reset() noexcept { *this = ImuInput(); }
  /// @param newest that has come; nullptr: none. A sample that says kStarting is none.
  /// @param seq of this cycle.
  /// @return nullptr without a sample that can be used: none, too old, or one that says that it is not good.
  /// One that cannot be (imu_watch.h) is none.
  const ImuReading* update(const Imu* newest, std::int64_t seq, double cycle_s) noexcept;
  /// Of the newest sample that has come, be it used or not; -1: none.
  std::int64_t newest_seq() const noexcept { return judged_seq_; }

 private:
  ImuWatch watch_;
  std::int64_t judged_seq_ = -1;
  bool trusted_ = true;
  Imu last_;
  ImuReading reading_;
};

}  // namespace sprung
