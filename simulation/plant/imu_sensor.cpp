#include "simulation/plant/imu_sensor.h"

#include <mujoco/mujoco.h>

#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

/// Apart from those of drives, link encoders (drive_train.cpp) and the torque sensor.
constexpr std::uint64_t kImuSignals = 1ULL << 35;
constexpr int kRate = 0, kForce = 3, kAttitude = 6, kRateBias = 9, kForceBias = 12, kTilt = 15,
              kYawDrift = 17;
constexpr std::int64_t kOnceARun = -1;
constexpr double kGravity_m_s2 = 9.81;  // model.xml's
constexpr int kSilent = 1, kSaysFault = 2, kLosesAttitude = 3, kFrozen = 4, kSpikes = 5;
constexpr std::int64_t kSpikeEach_samples = 50;
constexpr double kSpike_rad_s = 20.0;

}  // namespace

ImuSensor::ImuSensor(const ImuConfig& config, std::uint64_t seed) noexcept : config_(config), seed_(seed) {}

double ImuSensor::noise(int signal, std::int64_t cycle) const noexcept {
  return hash_noise(seed_, kImuSignals + static_cast<std::uint64_t>(signal), cycle);
}

Vec3 ImuSensor::specific_force_m_s2(const BaseMotion& motion, double interval_s) const noexcept {
  Vec3 world{};
  for (std::size_t i = 0; i < 3; ++i)
    world[i] = (motion.velocity_m_s[i] - last_.velocity_m_s[i]) / interval_s;
  world[2] += kGravity_m_s2;
  mjtNum back[4];
  mju_negQuat(back, motion.quaternion_wxyz.data());
  Vec3 trunk{};
  mju_rotVecQuat(trunk.data(), world.data(), back);
  return trunk;
}

/// The true one, turned about the trunk's axes by the tilt's error and noise, about the world's z by the
/// drift.
std::array<double, 4> ImuSensor::attitude(const BaseMotion& motion, std::int64_t cycle,
                                          double running_s) const noexcept {
  Vec3 error{};
  for (int axis = 0; axis < 3; ++axis) {
    error[axis] = config_.attitude_noise_rad * noise(kAttitude + axis, cycle) +
                  (axis < 2 ? config_.tilt_bias_rad * noise(kTilt + axis, kOnceARun) : 0.0);
  }
  std::array<double, 4> turned = motion.quaternion_wxyz;
  mju_quatIntegrate(turned.data(), error.data(), 1.0);
  const mjtNum up[3] = {0, 0, 1};
  mjtNum drift[4];
  mju_axisAngle2Quat(drift, up, config_.yaw_drift_rad_s * noise(kYawDrift, kOnceARun) * running_s);
  std::array<double, 4> measured{};
  mju_mulQuat(measured.data(), drift, turned.data());
  return measured;
}

/// Error of one axis of a vector that has white noise and a bias.
double ImuSensor::error(double noise_rms, int noise_signal, double bias_rms, int bias_signal,
                        std::int64_t cycle) const noexcept {
  return noise_rms * noise(noise_signal, cycle) + bias_rms * noise(bias_signal, kOnceARun);
}

void ImuSensor::measure(const BaseMotion& motion, double running_s) noexcept {
  const std::int64_t cycle = newest_.stamp.seq;
  newest_.measured_angular_velocity_rad_s = motion.angular_velocity_rad_s;
  newest_.measured_specific_force_m_s2 = specific_force_m_s2(motion, running_s - last_s_);
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    newest_.measured_angular_velocity_rad_s[i] += error(config_.rate_noise_rad_s, kRate + axis,
                                                        config_.rate_bias_rad_s, kRateBias + axis, cycle);
    newest_.measured_specific_force_m_s2[i] += error(config_.force_noise_m_s2, kForce + axis,
                                                     config_.force_bias_m_s2, kForceBias + axis, cycle);
  }
  if (fault_ != kLosesAttitude) newest_.measured_quaternion_wxyz = attitude(motion, cycle, running_s);
  newest_.status = fault_ == kLosesAttitude ? ImuStatus::kNoAttitude : ImuStatus::kGood;
  if (fault_ == kSpikes && cycle % kSpikeEach_samples == 0)
    newest_.measured_angular_velocity_rad_s[0] += kSpike_rad_s;
  if (fault_ == kSaysFault) newest_.status = ImuStatus::kFault;
}

void ImuSensor::sample(const BaseMotion& motion, const Stamp& stamp, double running_s) noexcept {
  if (fault_ == kFrozen) {
    newest_.stamp = stamp;
  } else if (fault_ != kSilent) {
    newest_ = Imu{};
    newest_.stamp = stamp;
    if (has_last_ && running_s > last_s_) measure(motion, running_s);
  }
  last_ = motion;
  last_s_ = running_s;
  has_last_ = true;
}

}  // namespace sprung::sim
