#pragma once
/// An IMU at the trunk's centre: rates, specific force and attitude, with noise and errors that a run keeps.
/// Pure.
#include <array>
#include <cstddef>
#include <cstdint>

#include "signals/sensors.h"
#include "signals/vec3.h"

namespace sprung::sim {

/// Errors: `noise` is drawn for each sample, `bias` and `drift` once for a run; all of them rms, for each
/// axis.
struct ImuConfig {
  double rate_noise_rad_s = 0.0;
  double rate_bias_rad_s = 0.0;
  double force_noise_m_s2 = 0.0;
  double force_bias_m_s2 = 0.0;
  double attitude_noise_rad = 0.0;
  double tilt_bias_rad = 0.0;    ///< about the trunk's x and y
  double yaw_drift_rad_s = 0.0;  ///< heading has nothing to hold on to
  // Optional keys of sim.yaml.
  double rate_walk_rad_s = 0.0;  ///< rms by which the bias has wandered after 1 s; grows as the root of time
  double force_walk_m_s2 = 0.0;  ///< the same
  Vec3 mounting_rad{};     ///< roll, then pitch, then yaw from the trunk's axes to the sensor's: nobody knows
  double latency_s = 0.0;  ///< age of the motion that a sample shows
};

/// What the trunk does, truly.
struct BaseMotion {
  std::array<double, 4> quaternion_wxyz{1, 0, 0, 0};  ///< trunk axes to world axes
  Vec3 velocity_m_s{};                                ///< of its origin, world axes
  Vec3 angular_velocity_rad_s{};                      ///< trunk axes
};

class ImuSensor {
 public:
  ImuSensor(const ImuConfig& config, std::uint64_t seed) noexcept;

  /// At a SYNC. Specific force is the mean since the sample before (an IMU integrates, it does not alias a
  /// foot's impact), kStarting as long as there is none. @param running_s since cycle 0.
  void sample(const BaseMotion& motion, const Stamp& stamp, double running_s) noexcept;
  /// The trunk was put somewhere else.
  void forget_motion() noexcept { has_last_ = false; }
  /// SimControlKind::kImu
  void set_fault(double value) noexcept { fault_ = static_cast<int>(value); }
  /// Of an older cycle while the sensor is silent.
  const Imu& newest() const noexcept { return newest_; }

 private:
  struct Past {
    BaseMotion motion;
    double at_s = 0.0;
  };
  static constexpr std::size_t kPast = 128;
  double noise(int signal, std::int64_t cycle) const noexcept;
  BaseMotion in_sensor_axes(const BaseMotion& motion) const noexcept;
  BaseMotion delayed(const BaseMotion& motion, double running_s) noexcept;
  void wander(std::int64_t cycle, double interval_s) noexcept;
  double error(double noise_rms, int noise_signal, double bias_rms, int bias_signal,
               std::int64_t cycle) const noexcept;
  void measure(const BaseMotion& motion, double running_s) noexcept;
  Vec3 specific_force_m_s2(const BaseMotion& motion, double interval_s) const noexcept;
  std::array<double, 4> attitude(const BaseMotion& motion, std::int64_t cycle,
                                 double running_s) const noexcept;

  ImuConfig config_;
  std::uint64_t seed_;
  int fault_ = 0;
  bool has_last_ = false;
  BaseMotion last_;
  double last_s_ = 0.0;
  std::array<Past, kPast> past_{};  ///< newest at past_count_ - 1, modulo its size
  std::size_t past_count_ = 0;
  Vec3 rate_walked_rad_s_{};
  Vec3 force_walked_m_s2_{};
  Imu newest_;
};

}  // namespace sprung::sim
