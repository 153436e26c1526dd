#include "estimator/torsion_sensor.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Teeth 0.3 mrad (facts papers D7), twist at breakaway 0.2 mrad.
constexpr double kStartStd_rad = 5e-4;
/// Of the motor's side seen once: 1.5 Nm on 25000 Nm/rad that stay for 0.05 s, as white noise of a rate.
constexpr double kNoise_rad2_s = 1.8e-10;
/// What friction's law gets wrong in one direction does not average out: 0.3 Nm on 25000 Nm/rad.
constexpr double kLeastStd_rad = 1.2e-5;

double soft_limit_rad(const GearTorsion& gear) noexcept {
  return gear.second_from_Nm > 0.0 ? gear.second_from_Nm / gear.stiffness_Nm_rad
                                   : std::numeric_limits<double>::infinity();
}

}  // namespace

double kinematic_error_rad(const GearTorsion& gear, double motor_angle_rad) noexcept {
  double error_rad = 0.0;
  for (std::size_t i = 0; i < gear.kinematic_terms; ++i) {
    const KinematicErrorTerm& term = gear.kinematic_error[i];
    const double angle_rad = term.order * motor_angle_rad;
    error_rad += term.cosine_rad * std::cos(angle_rad) + term.sine_rad * std::sin(angle_rad);
  }
  return error_rad;
}

double twist_rad(const GearTorsion& gear, double motor_position_rad, double link_position_rad,
                 double motor_angle_rad) noexcept {
  return motor_position_rad - link_position_rad + kinematic_error_rad(gear, motor_angle_rad);
}

TorsionTorque torsion_torque(const GearTorsion& gear, double twist_rad, double angle_std_rad) noexcept {
  if (!std::isfinite(twist_rad)) return {};
  const double size_rad = std::abs(twist_rad);
  const double soft_rad = std::min(size_rad, soft_limit_rad(gear));
  const double hard_rad = size_rad - soft_rad;
  const double torque_Nm = gear.stiffness_Nm_rad * soft_rad + gear.second_stiffness_Nm_rad * hard_rad;
  const double slope_Nm_rad = hard_rad > 0.0 ? gear.second_stiffness_Nm_rad : gear.stiffness_Nm_rad;
  return {std::copysign(torque_Nm, twist_rad), slope_Nm_rad * angle_std_rad};
}

double twist_of_rad(const GearTorsion& gear, double torque_Nm) noexcept {
  const double soft_Nm = std::min(std::abs(torque_Nm), gear.stiffness_Nm_rad * soft_limit_rad(gear));
  const double hard_Nm = std::abs(torque_Nm) - soft_Nm;
  return std::copysign(soft_Nm / gear.stiffness_Nm_rad + hard_Nm / gear.second_stiffness_Nm_rad, torque_Nm);
}

void TorsionZero::reset() noexcept {
  zero_rad_ = 0.0;
  variance_rad2_ = kStartStd_rad * kStartStd_rad;
}

void TorsionZero::observe(double twist_rad, double by_torque_rad, double dt_s) noexcept {
  const double difference_rad = twist_rad - by_torque_rad - zero_rad_;
  if (!std::isfinite(difference_rad) || !(dt_s > 0.0)) return;
  const double gain = variance_rad2_ / (variance_rad2_ + kNoise_rad2_s / dt_s);
  zero_rad_ += gain * difference_rad;
  variance_rad2_ = std::max((1.0 - gain) * variance_rad2_, kLeastStd_rad * kLeastStd_rad);
}

double TorsionZero::std_rad() const noexcept { return std::sqrt(variance_rad2_); }

TorsionTorque fused(const TorsionTorque& a, const TorsionTorque& b) noexcept {
  if (!std::isfinite(b.torque_Nm) || !std::isfinite(b.std_Nm)) return a;
  if (!std::isfinite(a.torque_Nm) || !std::isfinite(a.std_Nm)) return b;
  const double share_of_b = a.std_Nm * a.std_Nm / (a.std_Nm * a.std_Nm + b.std_Nm * b.std_Nm);
  return {a.torque_Nm + share_of_b * (b.torque_Nm - a.torque_Nm), std::sqrt(share_of_b) * b.std_Nm};
}

}  // namespace sprung
