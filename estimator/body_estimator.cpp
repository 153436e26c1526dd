#include "estimator/body_estimator.h"

#include <algorithm>
#include <cmath>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"

namespace sprung {

namespace {

/// Half a second of bias of a specific force, 0.05 m/s^2, are 25 mm/s: as bad as a foot.
constexpr double kLongestFlight_s = 0.5;
constexpr double kStartStd_m_s = 1.0;
/// Error of a standing foot's velocity, 0.03 m/s for 10 ms: it rolls, slides and twists its gears.
constexpr double kFootDensity_m2_s = 0.03 * 0.03 * 0.01;
/// With an IMU two feet are smoothed over 0.15 s, in which a bias and tilt of 0.05 m/s^2 that nobody knows
/// add 8 mm/s, a twelfth of a crawl. Without, over 10 ms.
constexpr double kImuDensity_m2_s3 = 2e-4;
constexpr double kBiasStd_m_s2 = 0.06;  // of a good MEMS unit, and 0.3 degrees of tilt
/// So that it is learned in some 10 s of standing feet: what one step's sliding feigns is no bias.
constexpr double kBiasDensity_m2_s5 = 3e-6;
constexpr double kMostBias_m_s2 = 0.3;  // [design choice] more is a fault, or feet that lie
constexpr double kUnknownDensity_m2_s3 = 0.05;
/// A foot that disagrees by more pulls no harder than this (Huber).
constexpr double kPlausible_m_s = 0.1;
constexpr double kHeightHolds_s = 0.05;
constexpr double kStands = 0.1;  ///< weight of all feet from which the robot is not in flight

Covariance3 row_by_row(const Eigen::Matrix3d& m) noexcept {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

}  // namespace

void BodyMotion::reset() noexcept {
  known_ = false;
  bias_m_s2_.setZero();
  bias_variance_m2_s4_ = kBiasStd_m_s2 * kBiasStd_m_s2;
}

void BodyMotion::start(const Attitude& attitude, const StandingFeet& feet) noexcept {
  known_ = true;
  in_flight_s_ = 0.0;
  velocity_m_s_.setZero();
  variance_m2_s2_ = kStartStd_m_s * kStartStd_m_s;
  covariance_m2_s3_ = 0.0;
  height_m_ = feet.height_m(attitude.trunk_to_world);
}

void BodyMotion::step(const ImuReading* imu, const Attitude& attitude, const StandingFeet& feet,
                      double dt_s) noexcept {
  const bool stands = feet.weight() > kStands;
  if (!known_ && !stands) return;
  if (!known_) start(attitude, feet);
  predict(imu, attitude, dt_s);
  for (const StandingFoot& foot : feet.feet())
    if (foot.weight > 0.0) correct(foot, attitude, dt_s);
  follow_height(attitude, feet, dt_s);
  in_flight_s_ = stands ? 0.0 : in_flight_s_ + dt_s;
  known_ = in_flight_s_ < kLongestFlight_s;
}

void BodyMotion::predict(const ImuReading* imu, const Attitude& attitude, double dt_s) noexcept {
  velocity_m_s_ = turned_by(-dt_s * attitude.angular_velocity_rad_s) * velocity_m_s_;
  if (imu == nullptr) {
    variance_m2_s2_ += dt_s * kUnknownDensity_m2_s3;
    return;
  }
  const Eigen::Vector3d up = attitude.trunk_to_world.conjugate() * Eigen::Vector3d::UnitZ();
  velocity_m_s_ += dt_s * (imu->specific_force_m_s2 - bias_m_s2_ - kGravity_m_s2 * up);
  variance_m2_s2_ += dt_s * (kImuDensity_m2_s3 - 2.0 * covariance_m2_s3_ + dt_s * bias_variance_m2_s4_);
  covariance_m2_s3_ -= dt_s * bias_variance_m2_s4_;
  bias_variance_m2_s4_ = std::min(kBiasStd_m_s2 * kBiasStd_m_s2,
                                  bias_variance_m2_s4_ + dt_s * kBiasDensity_m2_s5);
}

/// The ball of a foot that stands rolls: its centre moves by its radius times its own turning.
void BodyMotion::correct(const StandingFoot& foot, const Attitude& attitude, double dt_s) noexcept {
  const Eigen::Vector3d up = attitude.trunk_to_world.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d turning_rad_s = attitude.angular_velocity_rad_s + foot.link_rate_rad_s;
  const Eigen::Vector3d seen_m_s = foot.radius_m * turning_rad_s.cross(up) - foot.velocity_m_s -
                                   attitude.angular_velocity_rad_s.cross(foot.in_trunk_m);
  const Eigen::Vector3d surprise_m_s = seen_m_s - velocity_m_s_;
  const double plausible_m_s = kPlausible_m_s + 3.0 * std::sqrt(variance_m2_s2_);
  const double pull = std::min(1.0, plausible_m_s / std::max(plausible_m_s, surprise_m_s.norm()));
  const double foot_m2_s2 = kFootDensity_m2_s / (dt_s * foot.weight * pull);
  const double gain = variance_m2_s2_ / (variance_m2_s2_ + foot_m2_s2);
  const double bias_gain_1_s = covariance_m2_s3_ / (variance_m2_s2_ + foot_m2_s2);
  velocity_m_s_ += gain * surprise_m_s;
  bias_m_s2_ += bias_gain_1_s * surprise_m_s;
  bias_m_s2_ = bias_m_s2_.cwiseMax(-kMostBias_m_s2).cwiseMin(kMostBias_m_s2);
  variance_m2_s2_ *= 1.0 - gain;
  bias_variance_m2_s4_ -= bias_gain_1_s * covariance_m2_s3_;
  covariance_m2_s3_ *= 1.0 - gain;
}

void BodyMotion::follow_height(const Attitude& attitude, const StandingFeet& feet, double dt_s) noexcept {
  height_m_ += dt_s * (attitude.trunk_to_world * velocity_m_s_).z();
  if (feet.weight() <= 0.0) return;
  const double share = 1.0 - std::exp(-dt_s / kHeightHolds_s * std::min(1.0, feet.weight()));
  height_m_ += share * (feet.height_m(attitude.trunk_to_world) - height_m_);
}

BodyEstimator::BodyEstimator(const RobotConfig& robot)
    : cycle_s_(robot.cycle_s),
      has_imu_(robot.body.imu),
      imu_(robot.body.imu_latency_s),
      feet_(robot.legs),
      past_feet_(1 + static_cast<std::size_t>(std::lround(robot.body.imu_latency_s / robot.cycle_s)), feet_),
      late_s_(robot.body.imu_latency_s) {}

void BodyEstimator::reset() noexcept {
  imu_.reset();
  feet_.reset();
  std::fill(past_feet_.begin(), past_feet_.end(), feet_);
  attitude_.reset();
  motion_.reset();
  filter_.stop();
  acceleration_m_s2_.setZero();
}

void BodyEstimator::step(const std::vector<EstimatedLeg>& legs,
                         const std::vector<Eigen::Vector3d>& last_link_rates_rad_s, const Imu* imu,
                         std::int64_t seq, double dt_s, EstimatedBody& out) noexcept {
  const ImuReading* const reading = in_trunk_axes(imu_.update(has_imu_ ? imu : nullptr, seq, cycle_s_));
  feet_.update(legs, last_link_rates_rad_s, dt_s);
  past_feet_[++cycles_ % past_feet_.size()] = feet_;
  attitude_.step(reading, feet_, dt_s);
  if (attitude_.known())
    motion_.step(reading, {attitude_.trunk_to_world(), attitude_.angular_velocity_rad_s()}, feet_, dt_s);
  locate(reading, dt_s);
  if (reading != nullptr && attitude_.known()) learn_mounting(dt_s);
  out = EstimatedBody{};
  out.uses_imu = uses_imu_ = reading != nullptr;
  write(out);
}

const ImuReading* BodyEstimator::in_trunk_axes(const ImuReading* reading) noexcept {
  if (reading == nullptr) return nullptr;
  const Eigen::Quaterniond to_trunk = mounting_.sensor_to_trunk();
  reading_ = *reading;
  reading_.angular_velocity_rad_s = to_trunk * reading->angular_velocity_rad_s;
  reading_.specific_force_m_s2 = to_trunk * reading->specific_force_m_s2;
  reading_.attitude = reading->attitude * to_trunk.conjugate();
  return &reading_;
}

/// What it learns turns all that the IMU says from the next cycle on, and what the filter made of that with
/// it.
void BodyEstimator::learn_mounting(double dt_s) noexcept {
  const Eigen::Vector2d before_rad = mounting_.tilt_rad();
  mounting_.step(attitude_.trunk_to_world(), feet_);
  filter_.turn_trunk(
      {before_rad.x() - mounting_.tilt_rad().x(), before_rad.y() - mounting_.tilt_rad().y(), 0.0});
  const double speed_m_s = filter_.velocity_in_world_m_s().head<2>().norm();
  unsure_z_m_ += dt_s * speed_m_s * std::sqrt(mounting_.covariance_rad2().diagonal().maxCoeff());
}

void BodyEstimator::locate(const ImuReading* reading, double dt_s) noexcept {
  if (!filter_.runs()) {
    if (motion_.known()) filter_.start(attitude_.trunk_to_world());
    return;
  }
  BodyMeasurement measured;
  measured.by_imu = reading != nullptr;
  measured.angular_velocity_rad_s = attitude_.angular_velocity_rad_s();
  measured.has_up = reading == nullptr || reading->has_attitude;
  if (reading != nullptr) measured.specific_force_m_s2 = reading->specific_force_m_s2;
  const Eigen::Quaterniond now = reading != nullptr ? reading->attitude : attitude_.trunk_to_world();
  const Eigen::Quaterniond then = now * turned_by(-late_s_ * measured.angular_velocity_rad_s);
  measured.up = then.conjugate() * Eigen::Vector3d::UnitZ();
  filter_.step(measured, past_feet_[(cycles_ + 1) % past_feet_.size()], dt_s);
  acceleration_m_s2_ = reading != nullptr ? filter_.acceleration_in_world_m_s2(measured)
                                          : Eigen::Vector3d::Zero();
}

/// With how far the IMU may be askew, or how far from level the ground, which is then taken for it.
Eigen::Matrix3d BodyEstimator::attitude_covariance_rad2() const noexcept {
  constexpr double kSlope_rad = 0.05;  // [design choice]
  Eigen::Matrix3d askew_rad2 = Eigen::Matrix3d::Zero();
  askew_rad2.topLeftCorner<2, 2>() = uses_imu_ ? mounting_.covariance_rad2()
                                               : kSlope_rad * kSlope_rad * Eigen::Matrix2d::Identity();
  const Eigen::Matrix3d to_world = filter_.trunk_to_world().toRotationMatrix();
  return filter_.attitude_covariance_rad2() + to_world * askew_rad2 * to_world.transpose();
}

/// What the filter knows was so when the IMU measured; it goes on as it was.
Eigen::Quaterniond BodyEstimator::trunk_to_world() const noexcept {
  return filter_.trunk_to_world() * turned_by(late_s_ * attitude_.angular_velocity_rad_s());
}

Eigen::Vector3d BodyEstimator::velocity_in_trunk_m_s() const noexcept {
  return trunk_to_world().conjugate() * (filter_.velocity_in_world_m_s() + late_s_ * acceleration_m_s2_);
}

void BodyEstimator::odometry(BodyState& out) const noexcept {
  out = BodyState{};
  out.uses_imu = uses_imu_;
  out.slips = filter_.slips();
  if (!filter_.runs()) return;
  const Eigen::Quaterniond q = trunk_to_world();
  out.estimated_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
  out.estimated_position_in_world_m = to_vec3(filter_.position_in_world_m() +
                                              late_s_ * filter_.velocity_in_world_m_s());
  out.estimated_velocity_m_s = to_vec3(velocity_in_trunk_m_s());
  out.estimated_rate_bias_rad_s = to_vec3(filter_.rate_bias_rad_s());
  out.estimated_force_bias_m_s2 = to_vec3(filter_.force_bias_m_s2());
  out.estimated_imu_tilt_rad = {mounting_.tilt_rad().x(), mounting_.tilt_rad().y()};
  out.estimated_sinking_m_N = filter_.sinks_m_N();
  const Eigen::Matrix2d tilt_rad2 = mounting_.covariance_rad2();
  out.imu_tilt_covariance_rad2 = {tilt_rad2(0, 0), tilt_rad2(0, 1), tilt_rad2(1, 0), tilt_rad2(1, 1)};
  Eigen::Matrix3d place_m2 = filter_.position_covariance_m2();
  place_m2(2, 2) += unsure_z_m_ * unsure_z_m_;
  out.position_covariance_m2 = row_by_row(place_m2);
  out.attitude_covariance_rad2 = row_by_row(attitude_covariance_rad2());
  out.velocity_covariance_m2_s2 = row_by_row(filter_.velocity_covariance_m2_s2());
}

void BodyEstimator::write(EstimatedBody& out) const noexcept {
  if (!attitude_.known()) return;
  const Eigen::Quaterniond& q = attitude_.trunk_to_world();
  out.estimated_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
  out.estimated_angular_velocity_rad_s = to_vec3(attitude_.angular_velocity_rad_s());
  if (!motion_.known()) return;
  const bool by_filter = uses_imu_ && filter_.runs();
  out.estimated_velocity_m_s = to_vec3(by_filter ? velocity_in_trunk_m_s() : motion_.velocity_m_s());
  out.estimated_height_m = motion_.height_m();
}

}  // namespace sprung
