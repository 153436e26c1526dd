#include "estimator/imu_input.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"

namespace sprung {

namespace {

constexpr std::int64_t kLongestGap_cycles = 5;  // over a longer one anything may have happened

bool has_numbers(const Imu& imu) noexcept {
  return imu.status == ImuStatus::kGood || imu.status == ImuStatus::kNoAttitude;
}

Eigen::Quaterniond attitude_of(const Imu& imu) noexcept {
  const std::array<double, 4>& q = imu.measured_quaternion_wxyz;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

/// A quaternion of another length is none.
constexpr double kLengthError = 0.05;

}  // namespace

/// Each window begins at an attitude as measured, so that no bias adds up.
bool ImuWatch::turns_as_said(const Imu& sample, double dt_s) noexcept {
  if (sample.status != ImuStatus::kGood) {
    window_ = 0;
    return true;
  }
  if (window_ == 0 || window_ >= kWindow_samples || before_.status != ImuStatus::kGood) {
    expected_ = attitude_of(sample);
    turned_rad_ = 0.0;
    window_ = 1;
    return true;
  }
  const Eigen::Vector3d mean_rad_s = 0.5 * (to_eigen(before_.measured_angular_velocity_rad_s) +
                                            to_eigen(sample.measured_angular_velocity_rad_s));
  expected_ = expected_ * turned_by(dt_s * mean_rad_s);
  turned_rad_ += dt_s * mean_rad_s.norm();
  ++window_;
  return expected_.angularDistance(attitude_of(sample)) <= kMismatch_rad + kMismatchOfTurn * turned_rad_;
}

bool ImuWatch::agrees(const Imu& sample, double cycle_s) noexcept {
  const Eigen::Vector3d rate_rad_s = to_eigen(sample.measured_angular_velocity_rad_s);
  const double force_m_s2 = to_eigen(sample.measured_specific_force_m_s2).norm();
  const std::int64_t cycles = sample.stamp.seq - before_.stamp.seq;
  const bool follows = has_numbers(before_) && cycles >= 1 && cycles <= kLongestGap_cycles;
  if (!follows) window_ = 0;
  const double dt_s = follows ? cycle_s * static_cast<double>(cycles) : 0.0;
  const bool turns = turns_as_said(sample, dt_s);
  if (!(rate_rad_s.norm() <= kMostRate_rad_s) || !(force_m_s2 <= kMostForce_m_s2)) return false;
  if (!follows) return true;
  const double change_rad_s = (rate_rad_s - to_eigen(before_.measured_angular_velocity_rad_s)).norm();
  return turns && change_rad_s <= kRateNoise_rad_s + kMostTurning_rad_s2 * dt_s;
}

bool ImuWatch::repeats(const Imu& sample) noexcept {
  const bool rates = sample.measured_angular_velocity_rad_s == before_.measured_angular_velocity_rad_s;
  const bool forces = sample.measured_specific_force_m_s2 == before_.measured_specific_force_m_s2;
  equal_rates_ = rates ? equal_rates_ + 1 : 0;
  equal_forces_ = forces ? equal_forces_ + 1 : 0;
  return std::max(equal_rates_, equal_forces_) >= kFrozen_samples;
}

bool ImuWatch::trusts(const Imu& sample, double cycle_s) noexcept {
  if (!has_numbers(sample)) return true;  // it says so itself
  const bool stuck = repeats(sample);
  const bool good = agrees(sample, cycle_s) && !stuck;
  agreed_ = good ? std::min(agreed_ + 1, kAgree_samples) : 0;
  before_ = sample;
  return agreed_ >= kAgree_samples;
}

const ImuReading* ImuInput::update(const Imu* newest, std::int64_t seq, double cycle_s) noexcept {
  if (newest != nullptr && newest->status != ImuStatus::kStarting) {
    if (newest->stamp.seq != judged_seq_) trusted_ = watch_.trusts(*newest, cycle_s);
    judged_seq_ = newest->stamp.seq;
    if (trusted_) last_ = *newest;
  }
  const std::int64_t age_cycles = seq - last_.stamp.seq;
  const bool good = last_.status == ImuStatus::kGood || last_.status == ImuStatus::kNoAttitude;
  if (!good || std::abs(age_cycles) > kOldestImu_cycles) return nullptr;
  reading_.angular_velocity_rad_s = to_eigen(last_.measured_angular_velocity_rad_s);
  reading_.specific_force_m_s2 = to_eigen(last_.measured_specific_force_m_s2);
  if (!reading_.angular_velocity_rad_s.allFinite() || !reading_.specific_force_m_s2.allFinite())
    return nullptr;
  const std::array<double, 4>& q = last_.measured_quaternion_wxyz;
  const Eigen::Quaterniond measured(q[0], q[1], q[2], q[3]);
  reading_.has_attitude = last_.status == ImuStatus::kGood && std::abs(measured.norm() - 1.0) < kLengthError;
  const double late_s = latency_s_ + cycle_s * static_cast<double>(age_cycles);
  if (reading_.has_attitude)
    reading_.attitude = measured.normalized() * turned_by(late_s * reading_.angular_velocity_rad_s);
  return &reading_;
}

}  // namespace sprung
