#include "estimator/imu_input.h"

#include <cmath>
#include <cstdlib>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"

namespace sprung {
namespace {

/// A quaternion of another length is none.
constexpr double kLengthError = 0.05;

}  // namespace

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
  if (reading_.has_attitude) {
    const double age_s = cycle_s * static_cast<double>(age_cycles);
    reading_.attitude = measured.normalized() * turned_by(age_s * reading_.angular_velocity_rad_s);
  }
  return &reading_;
}

}  // namespace sprung
