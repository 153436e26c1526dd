#include "simulation/plant/imu_sensor.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

/// Apart from those of drives, link encoders (drive_train.cpp) and the torque sensor.
constexpr std::uint64_t kImuSignals = 1ULL << 35;
constexpr int kRate = 0, kForce = 3, kAttitude = 6, kRateBias = 9, kForceBias = 12, kTilt = 15,
              kYawDrift = 17, kRateWalk = 18, kForceWalk = 21;
constexpr std::int64_t kOnceARun = -1;
constexpr double kGravity_m_s2 = 9.81;  // model.xml's
constexpr int kSilent = 1, kSaysFault = 2, kLosesAttitude = 3, kFrozen = 4, kSpikes = 5;
constexpr std::int64_t kSpikeEach_samples = 50;
constexpr double kSpike_rad_s = 20.0;

/// Between two samples: so near to each other that the chord is the arc.
BaseMotion between(const BaseMotion& from, const BaseMotion& to, double share) noexcept {
  BaseMotion motion;
  double same_way = 0.0;
  for (std::size_t i = 0; i < 4; ++i) same_way += from.quaternion_wxyz[i] * to.quaternion_wxyz[i];
  for (std::size_t i = 0; i < 4; ++i)
    motion.quaternion_wxyz[i] = (1 - share) * std::copysign(1.0, same_way) * from.quaternion_wxyz[i] +
                                share * to.quaternion_wxyz[i];
  mju_normalize4(motion.quaternion_wxyz.data());
  for (std::size_t i = 0; i < 3; ++i) {
    motion.velocity_m_s[i] = (1 - share) * from.velocity_m_s[i] + share * to.velocity_m_s[i];
    motion.angular_velocity_rad_s[i] = (1 - share) * from.angular_velocity_rad_s[i] +
                                       share * to.angular_velocity_rad_s[i];
  }
  return motion;
}

}  // namespace

ImuSensor::ImuSensor(const ImuConfig& config, std::uint64_t seed) noexcept : config_(config), seed_(seed) {}

double ImuSensor::noise(int signal, std::int64_t cycle) const noexcept {
  return hash_noise(seed_, kImuSignals + static_cast<std::uint64_t>(signal), cycle);
}

BaseMotion ImuSensor::in_sensor_axes(const BaseMotion& motion) const noexcept {
  if (config_.mounting_rad == Vec3{}) return motion;
  mjtNum turn[4] = {1, 0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    mjtNum direction[3] = {0, 0, 0}, one[4], sum[4];
    direction[axis] = 1;
    mju_axisAngle2Quat(one, direction, config_.mounting_rad[static_cast<std::size_t>(axis)]);
    mju_mulQuat(sum, one, turn);
    mju_copy4(turn, sum);
  }
  BaseMotion turned = motion;
  mju_mulQuat(turned.quaternion_wxyz.data(), motion.quaternion_wxyz.data(), turn);
  mjtNum back[4];
  mju_negQuat(back, turn);
  mju_rotVecQuat(turned.angular_velocity_rad_s.data(), motion.angular_velocity_rad_s.data(), back);
  return turned;
}

/// As it was `latency` ago; before there is one so old, the oldest.
BaseMotion ImuSensor::delayed(const BaseMotion& motion, double running_s) noexcept {
  if (config_.latency_s <= 0.0) return motion;
  if (!has_last_) past_count_ = 0;
  past_[past_count_++ % kPast] = {motion, running_s};
  const std::size_t oldest = past_count_ > kPast ? past_count_ - kPast : 0;
  const double wanted_s = running_s - config_.latency_s;
  std::size_t later = past_count_ - 1;
  while (later > oldest && past_[(later - 1) % kPast].at_s > wanted_s) --later;
  const Past& to = past_[later % kPast];
  if (later == oldest) return to.motion;
  const Past& from = past_[(later - 1) % kPast];
  return between(from.motion, to.motion, std::min(1.0, (wanted_s - from.at_s) / (to.at_s - from.at_s)));
}

void ImuSensor::wander(std::int64_t cycle, double interval_s) noexcept {
  const double root_s = std::sqrt(interval_s);
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    if (config_.rate_walk_rad_s > 0.0)
      rate_walked_rad_s_[i] += config_.rate_walk_rad_s * root_s * noise(kRateWalk + axis, cycle);
    if (config_.force_walk_m_s2 > 0.0)
      force_walked_m_s2_[i] += config_.force_walk_m_s2 * root_s * noise(kForceWalk + axis, cycle);
  }
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
  wander(cycle, running_s - last_s_);
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    newest_.measured_angular_velocity_rad_s[i] += error(config_.rate_noise_rad_s, kRate + axis,
                                                        config_.rate_bias_rad_s, kRateBias + axis, cycle);
    newest_.measured_specific_force_m_s2[i] += error(config_.force_noise_m_s2, kForce + axis,
                                                     config_.force_bias_m_s2, kForceBias + axis, cycle);
    newest_.measured_angular_velocity_rad_s[i] += rate_walked_rad_s_[i];
    newest_.measured_specific_force_m_s2[i] += force_walked_m_s2_[i];
  }
  if (fault_ != kLosesAttitude) newest_.measured_quaternion_wxyz = attitude(motion, cycle, running_s);
  newest_.status = fault_ == kLosesAttitude ? ImuStatus::kNoAttitude : ImuStatus::kGood;
  if (fault_ == kSpikes && cycle % kSpikeEach_samples == 0)
    newest_.measured_angular_velocity_rad_s[0] += kSpike_rad_s;
  if (fault_ == kSaysFault) newest_.status = ImuStatus::kFault;
}

void ImuSensor::sample(const BaseMotion& true_motion, const Stamp& stamp, double running_s) noexcept {
  const BaseMotion motion = delayed(in_sensor_axes(true_motion), running_s);
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
