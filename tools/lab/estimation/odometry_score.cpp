#include "tools/lab/estimation/odometry_score.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"
#include "signals/angles.h"

namespace sprung {
namespace {

Eigen::Quaterniond quaternion(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

double nees(const Eigen::Vector3d& error, const Covariance3& covariance) {
  const Eigen::Matrix3d c = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data());
  return error.dot(c.inverse() * error);
}

}  // namespace

void OdometryScore::begin(const BodyState& estimated, const SimTruth& truth) {
  begun_ = true;
  ours_from_true_ = turned_about_z(yaw_rad(quaternion(estimated.estimated_quaternion_wxyz)) -
                                   yaw_rad(quaternion(truth.base_quaternion_wxyz)));
  last_m_ = to_eigen(truth.base_in_world_m);
  heading_rad_ = leftmost_rad_ = rightmost_rad_ = yaw_rad(quaternion(estimated.estimated_quaternion_wxyz));
  origin_m_ = last_m_ - ours_from_true_.conjugate() * to_eigen(estimated.estimated_position_in_world_m);
}

void OdometryScore::add_tilt(const Eigen::Quaterniond& truly) {
  const double tilt_rad = turn_rad_.head<2>().norm();
  worst_tilt_rad_ = std::max(worst_tilt_rad_, tilt_rad);
  const double now_rad = yaw_rad(ours_from_true_ * truly);
  heading_rad_ += std::remainder(now_rad - heading_rad_, 2.0 * kPi);
  leftmost_rad_ = std::max(leftmost_rad_, heading_rad_);
  rightmost_rad_ = std::min(rightmost_rad_, heading_rad_);
  if (leftmost_rad_ - rightmost_rad_ < kTurned_rad) return;
  worst_turned_rad_ = std::fmax(worst_turned_rad_, tilt_rad);  // a NaN is less
}

void OdometryScore::add(const BodyState& estimated, const SimTruth& truth) {
  if (!std::isfinite(estimated.estimated_position_in_world_m[0])) return;
  if (!begun_) begin(estimated, truth);
  const Eigen::Vector3d true_m = to_eigen(truth.base_in_world_m);
  const double step_m = (true_m - last_m_).head<2>().norm();
  if (step_m >= kStep_m) {
    way_m_ += step_m;
    last_m_ = true_m;
  }
  place_m_ = to_eigen(estimated.estimated_position_in_world_m) - ours_from_true_ * (true_m - origin_m_);
  position_nees_ = nees(place_m_, estimated.position_covariance_m2);

  const Eigen::Quaterniond ours = quaternion(estimated.estimated_quaternion_wxyz);
  const Eigen::Quaterniond off = ours *
                                 (ours_from_true_ * quaternion(truth.base_quaternion_wxyz)).conjugate();
  turn_rad_ = std::copysign(2.0, off.w()) * off.vec();
  add_tilt(quaternion(truth.base_quaternion_wxyz));

  const Eigen::Vector3d velocity_m_s = ours * to_eigen(estimated.estimated_velocity_m_s) -
                                       ours_from_true_ * to_eigen(truth.base_velocity_m_s);
  const double in_trunk_m_s = (to_eigen(estimated.estimated_velocity_m_s) -
                               quaternion(truth.base_quaternion_wxyz).conjugate() *
                                   to_eigen(truth.base_velocity_m_s))
                                  .norm();
  worst_velocity_m_s_ = std::max(worst_velocity_m_s_, in_trunk_m_s);
  velocity_sum_m2_s2_ += in_trunk_m_s * in_trunk_m_s;
  velocity_nees_sum_ += nees(velocity_m_s, estimated.velocity_covariance_m2_s2);
  ++cycles_;
}

double OdometryScore::velocity_rms_m_s() const noexcept {
  return cycles_ > 0 ? std::sqrt(velocity_sum_m2_s2_ / cycles_) : kNaN;
}

double OdometryScore::velocity_nees() const noexcept {
  return cycles_ > 0 ? velocity_nees_sum_ / cycles_ : kNaN;
}

}  // namespace sprung
