#include "tools/station/frames/trunk_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung::station {

namespace {

bool finite(const Eigen::Vector3d& v) { return v.allFinite(); }
bool finite(const Eigen::Quaterniond& q) { return q.coeffs().allFinite() && q.norm() > 0.5; }

}  // namespace

void TrunkPose::reset() { *this = TrunkPose(std::move(legs_)); }

void TrunkPose::update(const TrunkInput& input, double dt_s) {
  if (finite(input.true_position_m) && finite(input.true_attitude)) {
    position_m_ = input.true_position_m;
    attitude_ = input.true_attitude.normalized();
    source_ = TrunkSource::kSimulation;
    return;
  }
  if (finite(input.estimated_attitude)) return estimate(input, dt_s);
  attitude_.setIdentity();
  source_ = TrunkSource::kLegs;
  position_m_.z() = height_on_feet_m(input);
}

void TrunkPose::estimate(const TrunkInput& input, double dt_s) {
  source_ = TrunkSource::kEstimate;
  attitude_ = into_odometry_ * input.estimated_attitude.normalized();
  go_on(input, dt_s);
  if (!finite(input.odometry_m) || !finite(input.odometry_attitude)) return odometry_m_.reset();
  source_ = TrunkSource::kOdometry;
  if (!odometry_m_ || *odometry_m_ != input.odometry_m) take_odometry(input);
}

void TrunkPose::go_on(const TrunkInput& input, double dt_s) {
  if (finite(input.estimated_velocity_m_s)) {
    const Eigen::Vector3d travelled_m = attitude_ * input.estimated_velocity_m_s * dt_s;
    position_m_.head<2>() += travelled_m.head<2>();
  }
  if (!odometry_m_ && std::isfinite(input.estimated_height_m)) position_m_.z() = input.estimated_height_m;
}

/// It comes in every fifth cycle; between two the trunk goes on by the estimate.
void TrunkPose::take_odometry(const TrunkInput& input) {
  if (!odometry_m_) began_m_ = position_m_ - input.odometry_m;
  odometry_m_ = input.odometry_m;
  position_m_ = began_m_ + input.odometry_m;
  into_odometry_ = input.odometry_attitude.normalized() * input.estimated_attitude.normalized().conjugate();
  attitude_ = input.odometry_attitude.normalized();
}

double TrunkPose::height_on_feet_m(const TrunkInput& input) const {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < legs_.size() && i < input.foot_in_hip_m.size(); ++i) {
    if (!finite(input.foot_in_hip_m[i]) || legs_[i].kinematics == kOneLink) continue;
    const double foot_m = legs_[i].hip_in_trunk_m[2] + input.foot_in_hip_m[i].z() - legs_[i].foot_radius_m;
    lowest_m = std::min(lowest_m, foot_m);
  }
  return std::isfinite(lowest_m) ? -lowest_m : position_m_.z();
}

}  // namespace sprung::station
