#pragma once
/// The newest IMU sample that can be used, and how old it is. Pure.
#include <Eigen/Geometry>
#include <cstdint>

#include "signals/sensors.h"

namespace sprung {

/// [design choice] what five times the weight of pegasus (30 kg) under one foot, 0.33 m from the middle, does
/// to a trunk of 0.5 kg m^2.
inline constexpr double kMostTurning_rad_s2 = 1000.0;
inline constexpr double kMostRate_rad_s = 35.0;   // the range of common sensors, 2000 degrees per second
inline constexpr double kMostForce_m_s2 = 320.0;  // twice the range of common ones, 16 g
inline constexpr double kRateNoise_rad_s = 0.3;   // of bad ones, times ten
inline constexpr int kWindow_samples = 50;        // 0.1 s at 500 Hz
inline constexpr double kMismatch_rad = 0.03;     // over a window: 0.3 rad/s that are not there
inline constexpr double kMismatchOfTurn = 0.15;   // of what turned: scale, and 15 ms of lag
inline constexpr int kFrozen_samples = 20;
inline constexpr int kAgree_samples = 20;  ///< in a row until it is followed again

/// Whether an IMU's numbers can be those of a trunk: one that jumps, whose attitude does not turn as its own
/// rates say, or that repeats itself is not followed.
///
/// From sample to sample the rate changes by no more than kMostTurning allows. Over kWindow_samples the
/// attitude turns as the rates add up, but for what an attitude filter lags behind. White noise never gives
/// the same numbers again: kFrozen_samples equal rates or equal forces are a sensor, or its driver, that
/// hangs. A gyro and an attitude that are wrong together and smoothly cannot be told from a trunk that turns.
class ImuWatch {
 public:
  void reset() noexcept { *this = ImuWatch(); }
  /// Call once with each sample. @return whether it can be used.
  bool trusts(const Imu& sample, double cycle_s) noexcept;

 private:
  bool agrees(const Imu& sample, double cycle_s) noexcept;
  bool turns_as_said(const Imu& sample, double dt_s) noexcept;
  bool repeats(const Imu& sample) noexcept;

  Imu before_;
  int agreed_ = kAgree_samples;  ///< at first it is believed
  int equal_rates_ = 0, equal_forces_ = 0;
  int window_ = 0;                                                ///< samples in it; 0: none has begun
  Eigen::Quaterniond expected_ = Eigen::Quaterniond::Identity();  ///< attitude, by the rates since it began
  double turned_rad_ = 0.0;
};

/// A sample older than this counts as silence.
inline constexpr std::int64_t kOldestImu_cycles = 5;

struct ImuReading {
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();  ///< trunk axes
  Eigen::Vector3d specific_force_m_s2 = Eigen::Vector3d::Zero();
  /// Now: turned on by the rate for as long as it is late.
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  bool has_attitude = false;
};

class ImuInput {
 public:
  /// @param latency_s from the measurement to the cycle that a sample belongs to, BodyConfig's.
  explicit ImuInput(double latency_s = 0.0) noexcept : latency_s_(latency_s) {}
  void reset() noexcept { *this = ImuInput(latency_s_); }
  /// @param newest that has come; nullptr: none. A sample that says kStarting is none.
  /// @param seq of this cycle.
  /// @return nullptr without a sample that can be used: none, too old, or one that says that it is not good.
  /// One that cannot be (ImuWatch) is none.
  const ImuReading* update(const Imu* newest, std::int64_t seq, double cycle_s) noexcept;
  /// Of the newest sample that has come, be it used or not; -1: none.
  std::int64_t newest_seq() const noexcept { return judged_seq_; }

 private:
  double latency_s_;
  ImuWatch watch_;
  std::int64_t judged_seq_ = -1;
  bool trusted_ = true;
  Imu last_;
  ImuReading reading_;
};

}  // namespace sprung
