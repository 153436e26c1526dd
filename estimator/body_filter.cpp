#include "estimator/body_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"

namespace sprung {
namespace {

constexpr int kTurn = 0, kSpeed = 3, kPlace = 6, kRateBias = 9, kForceBias = 12, kFeet = 15,
              kSinks = kFeet + 3 * BodyFilter::kLegs;

// Densities of white noise. Of good MEMS units noise itself is a tenth of these: samples come late, trunks
// shake.
constexpr double kRate_rad2_s = 1e-3 * 1e-3;
constexpr double kForce_m2_s3 = 2e-4;
constexpr double kRateWalk_rad2_s3 = 3e-5 * 3e-5;
constexpr double kForceWalk_m2_s5 = 1e-3 * 1e-3;
// Without an IMU: rates of the feet, and a trunk that may be pushed.
constexpr double kRateOfFeet_rad2_s = 0.03 * 0.03;
constexpr double kUnknownForce_m2_s3 = 0.05;
constexpr double kRateBias_rad_s = 0.004, kForceBias_m_s2 = 0.06;  // of good MEMS units
constexpr double kStartTilt_rad = 0.05, kStartSpeed_m_s = 1.0;
/// Of a tilt, whose errors last: 4 mrad for 10 s. Of the plane of the feet, which is taken for level: 50 mrad
/// for a twentieth of a second.
constexpr double kTilt_rad2_s = 0.004 * 0.004 * 10.0;
constexpr double kTiltOfFeet_rad2_s = 0.05 * 0.05 * 0.05;
/// Of a foot's place as the encoders say it: 1.5 mm for 10 ms.
constexpr double kFoot_m2_s = 0.0015 * 0.0015 * 0.01;
/// Rubber on a hard floor, 30 kN/m, or softer; on stone it is nothing.
constexpr double kSinks_m_N = 1.0 / 30e3, kSinksStd_m_N = 1.0 / 40e3, kMostSinks_m_N = 1.0 / 5e3;
constexpr double kSinksWalk_m2_N2_s = 1e-12;  // [design choice] another ground after some minutes
/// A foot that stands creeps, and where the trunk moves over it legs and zeros that are a little off make it
/// seem to move by a share of that, which lasts for a stance.
constexpr double kCreep_m2_s = 0.001 * 0.001, kSeems = 0.03, kStance_s = 0.5;
/// [design choice] Errors of feet last longer than a cycle, and the covariance is what costs time.
constexpr double kCorrects_s = 0.01 - 1e-9;
/// Weights from which a foot has come to stand, with which it says something, and below which it leaves: one
/// that bears little is already on its way.
constexpr double kAnchors = 0.7, kSays = 0.5, kLeaves = 0.3;
/// [design choice] A jump is over by then; and how fast a trunk that hangs or is carried goes: 0.5 m/s for a
/// second, so that after a quarter of an hour its place is known to 15 m.
constexpr double kUnheld_s = 0.5, kAtRest_m2_s = 0.5 * 0.5 * 1.0;
constexpr double kSurprise = 16.27;  // chi-square of three degrees of freedom, passed once in 1000 times
/// [design choice] What is the same all the time and nobody measures: feet that roll, and legs and their
/// zeros, which make each step longer or shorter by 0.3 percent.
constexpr double kWay = 0.003, kSpeedShare = 0.008;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) noexcept {
  Eigen::Matrix3d out;
  out << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return out;
}

template <class Matrix>
struct RowsOf {
  Matrix& of;
  void add(int to, const Eigen::Matrix3d& by, int from) const noexcept {
    of.template middleRows<3>(to) += by.lazyProduct(of.template middleRows<3>(from));
  }
};
template <class Matrix>
struct ColumnsOf {
  Matrix& of;
  void add(int to, const Eigen::Matrix3d& by, int from) const noexcept {
    of.template middleCols<3>(to) += of.template middleCols<3>(from).lazyProduct(by.transpose());
  }
};

}  // namespace

BodyFilter::BodyFilter() noexcept : sinks_m_N_(kSinks_m_N) {}

void BodyFilter::start(const Eigen::Quaterniond& tilted) noexcept {
  const double heading_rad = was_started_ ? yaw_rad(attitude_) : yaw_rad(tilted);
  const double heading_rad2 = was_started_
                                  ? covariance_(kTurn + 2, kTurn + 2) + kStartTilt_rad * kStartTilt_rad
                                  : 0.0;
  const Eigen::Matrix3d place_m2 = place_covariance_m2();
  attitude_ = (turned_about_z(heading_rad - yaw_rad(tilted)) * tilted).normalized();
  runs_ = was_started_ = true;
  velocity_m_s_.setZero();
  rate_bias_rad_s_.setZero();
  force_bias_m_s2_.setZero();
  feet_ = {};
  uncorrected_s_ = unheld_s_ = 0.0;
  const auto variance = [this](int at, double std) {
    covariance_.diagonal().segment<3>(at).setConstant(std * std);
  };
  covariance_.setZero();
  variance(kTurn, kStartTilt_rad);
  covariance_(kTurn + 2, kTurn + 2) = heading_rad2;  // at first it is what it is called
  // The place is as sure as before, whichever way the trunk is turned: its right-invariant error is not.
  const Eigen::Matrix3d carried = cross(position_m_) * covariance_.block<3, 3>(kTurn, kTurn);
  covariance_.block<3, 3>(kPlace, kTurn) = carried;
  covariance_.block<3, 3>(kTurn, kPlace) = carried.transpose();
  covariance_.block<3, 3>(kPlace, kPlace) = place_m2 - carried * cross(position_m_);
  variance(kSpeed, kStartSpeed_m_s);
  variance(kRateBias, kRateBias_rad_s);
  variance(kForceBias, kForceBias_m_s2);
  covariance_(kSinks, kSinks) = kSinksStd_m_N * kSinksStd_m_N;
}

void BodyFilter::step(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept {
  predict(measured, feet, dt_s);
  uncorrected_s_ += dt_s;
  if (uncorrected_s_ < kCorrects_s) return;
  spread(measured, feet, uncorrected_s_);
  correct_tilt(measured, uncorrected_s_);
  const int legs = std::min(kLegs, static_cast<int>(feet.feet().size()));
  for (int i = 0; i < legs; ++i) follow_foot(i, feet.feet()[static_cast<std::size_t>(i)], uncorrected_s_);
  const bool held = std::any_of(feet_.begin(), feet_.end(), [](const Foot& foot) { return foot.anchored; });
  unheld_s_ = held ? 0.0 : unheld_s_ + uncorrected_s_;
  if (unheld_s_ > kUnheld_s) rest(uncorrected_s_);
  uncorrected_s_ = 0.0;
  // What rounding leaves unequal would grow.
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

Eigen::Vector3d BodyFilter::acceleration_in_world_m_s2(const BodyMeasurement& measured) const noexcept {
  if (!measured.specific_force_m_s2.allFinite()) return Eigen::Vector3d::Zero();
  return attitude_ * (measured.specific_force_m_s2 - force_bias_m_s2_) -
         kGravity_m_s2 * Eigen::Vector3d::UnitZ();
}

void BodyFilter::predict(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept {
  const Eigen::Vector3d rate_rad_s = measured.angular_velocity_rad_s - rate_bias_rad_s_;
  const Eigen::Vector3d acceleration_m_s2 = acceleration_in_world_m_s2(measured);
  position_m_ += dt_s * (velocity_m_s_ + 0.5 * dt_s * acceleration_m_s2);
  velocity_m_s_ += dt_s * acceleration_m_s2;
  attitude_ = (attitude_ * turned_by(dt_s * rate_rad_s)).normalized();
  way_m_ += dt_s * velocity_m_s_.head<2>().norm();
  // The ball of a foot that stands rolls: its centre moves by its radius times its own turning.
  for (int i = 0; i < kLegs && i < static_cast<int>(feet.feet().size()); ++i) {
    const StandingFoot& foot = feet.feet()[static_cast<std::size_t>(i)];
    const Eigen::Vector3d turning_rad_s = attitude_ * (rate_rad_s + foot.link_rate_rad_s);
    feet_[static_cast<std::size_t>(i)].in_world_m += dt_s * foot.radius_m *
                                                     turning_rad_s.cross(Eigen::Vector3d::UnitZ());
  }
}

/// Rows, or columns, of the covariance as the errors flow in a cycle, I + A dt (facts D14), biases
/// with them. In an order in which each is made of what others were before.
template <class Block>
void BodyFilter::flow(const Block& block, bool biases, double dt_s) const noexcept {
  const Eigen::Matrix3d falls = cross(-kGravity_m_s2 * dt_s * Eigen::Vector3d::UnitZ());
  block.add(kPlace, dt_s * Eigen::Matrix3d::Identity(), kSpeed);
  block.add(kSpeed, falls, kTurn);
  if (!biases) return;
  const Eigen::Matrix3d turns = -dt_s * attitude_.toRotationMatrix();
  block.add(kPlace, cross(position_m_) * turns, kRateBias);
  block.add(kSpeed, cross(velocity_m_s_) * turns, kRateBias);
  block.add(kSpeed, turns, kForceBias);
  for (int i = 0; i < kLegs; ++i) {
    const Foot& foot = feet_[static_cast<std::size_t>(i)];
    if (foot.anchored) block.add(kFeet + 3 * i, cross(foot.in_world_m) * turns, kRateBias);
  }
  block.add(kTurn, turns, kRateBias);
}

/// What a rate that is off turns, it turns about the world's origin.
void BodyFilter::add_rate_noise(double density, double dt_s) noexcept {
  Gain by = Gain::Zero();
  by.middleRows<3>(kTurn).setIdentity();
  by.middleRows<3>(kSpeed) = cross(velocity_m_s_);
  by.middleRows<3>(kPlace) = cross(position_m_);
  for (int i = 0; i < kLegs; ++i) {
    const Foot& foot = feet_[static_cast<std::size_t>(i)];
    if (foot.anchored) by.middleRows<3>(kFeet + 3 * i) = cross(foot.in_world_m);
  }
  covariance_.noalias() += density * dt_s * (by * by.transpose());
}

void BodyFilter::spread(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept {
  flow(RowsOf<Covariance>{covariance_}, measured.by_imu, dt_s);
  flow(ColumnsOf<Covariance>{covariance_}, measured.by_imu, dt_s);
  add_rate_noise(measured.by_imu ? kRate_rad2_s : kRateOfFeet_rad2_s, dt_s);
  const bool felt = measured.by_imu && measured.specific_force_m_s2.allFinite();
  const auto grow = [&](int at, double density) {
    covariance_.diagonal().segment<3>(at).array() += density * dt_s;
  };
  grow(kSpeed, felt ? kForce_m2_s3 : kUnknownForce_m2_s3);
  if (measured.by_imu) {
    grow(kRateBias, kRateWalk_rad2_s3);
    grow(kForceBias, kForceWalk_m2_s5);
  }
  double& sinks = covariance_(kSinks, kSinks);
  sinks = std::min(sinks + kSinksWalk_m2_N2_s * dt_s, kSinksStd_m_N * kSinksStd_m_N);
  for (int i = 0; i < kLegs && i < static_cast<int>(feet.feet().size()); ++i) {
    const auto leg = static_cast<std::size_t>(i);
    const double seems_m_s = kSeems * feet.feet()[leg].velocity_m_s.norm();
    if (feet_[leg].anchored) grow(kFeet + 3 * i, kCreep_m2_s + kStance_s * seems_m_s * seems_m_s);
  }
}

/// The measured up, turned into the world, is off its z by what the attitude is turned about x and y.
void BodyFilter::correct_tilt(const BodyMeasurement& measured, double dt_s) noexcept {
  if (!measured.has_up) return;
  const Eigen::Vector3d up = attitude_ * measured.up;
  const Eigen::Vector2d surprise(-up.y(), up.x());
  const double noise = (measured.by_imu ? kTilt_rad2_s : kTiltOfFeet_rad2_s) / dt_s;
  const Eigen::Matrix<double, kStates, 2> seen = covariance_.middleCols<2>(kTurn);
  const Eigen::Matrix2d spread_2 = seen.middleRows<2>(kTurn) + noise * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, kStates, 2> gain = seen * spread_2.inverse();
  move_by(gain * surprise);
  covariance_.noalias() -= gain * seen.transpose();
}

/// Its velocity is 0, more or less.
void BodyFilter::rest(double dt_s) noexcept {
  const Gain seen = covariance_.middleCols<3>(kSpeed);
  const Eigen::Matrix3d spread_m2_s2 = seen.middleRows<3>(kSpeed) +
                                       kAtRest_m2_s / dt_s * Eigen::Matrix3d::Identity();
  const Gain gain = seen * spread_m2_s2.inverse();
  move_by(gain * velocity_m_s_);
  covariance_.noalias() -= gain * seen.transpose();
}

void BodyFilter::follow_foot(int leg, const StandingFoot& foot, double dt_s) noexcept {
  Foot& mine = feet_[static_cast<std::size_t>(leg)];
  if (!(foot.weight > kLeaves)) return release(leg);
  if (!mine.anchored) {
    if (foot.weight >= kAnchors) anchor(leg, foot);
    return;
  }
  if (foot.weight < kSays) return;
  const int at = kFeet + 3 * leg;
  const Eigen::Vector3d surprise_m = ground_below(foot) - mine.in_world_m;
  Gain seen = covariance_.middleCols<3>(kPlace) - covariance_.middleCols<3>(at);
  seen.col(2) += foot.load_N * covariance_.col(kSinks);
  Eigen::Matrix3d spread_m2 = seen.middleRows<3>(kPlace) - seen.middleRows<3>(at);
  spread_m2.row(2) += foot.load_N * seen.row(kSinks);
  spread_m2 += kFoot_m2_s / (dt_s * foot.weight) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d certainty = spread_m2.inverse();
  if (surprise_m.dot(certainty * surprise_m) > kSurprise) {
    ++slips_;
    return anchor(leg, foot);
  }
  const Gain gain = seen * certainty;
  move_by(gain * surprise_m);
  covariance_.noalias() -= gain * seen.transpose();
}

/// Where it would be without a load: it sinks in by that.
Eigen::Vector3d BodyFilter::ground_below(const StandingFoot& foot) const noexcept {
  return position_m_ + attitude_ * foot.in_trunk_m + foot.load_N * sinks_m_N_ * Eigen::Vector3d::UnitZ();
}

/// It stands where the encoders say, as uncertain as the trunk, and a little more.
void BodyFilter::anchor(int leg, const StandingFoot& foot) noexcept {
  release(leg);
  Foot& mine = feet_[static_cast<std::size_t>(leg)];
  mine.anchored = true;
  mine.in_world_m = ground_below(foot);
  const int at = kFeet + 3 * leg;
  Rows as_trunk = covariance_.middleRows<3>(kPlace);
  as_trunk.row(2) += foot.load_N * covariance_.row(kSinks);
  covariance_.middleRows<3>(at) = as_trunk;
  Gain likewise = covariance_.middleCols<3>(kPlace);
  likewise.col(2) += foot.load_N * covariance_.col(kSinks);
  covariance_.middleCols<3>(at) = likewise;
  covariance_.diagonal().segment<3>(at).array() += kFoot_m2_s / 0.01;
}

void BodyFilter::release(int leg) noexcept {
  feet_[static_cast<std::size_t>(leg)].anchored = false;
  covariance_.middleRows<3>(kFeet + 3 * leg).setZero();
  covariance_.middleCols<3>(kFeet + 3 * leg).setZero();
}

/// Takes an error off: to the left, as it is right-invariant.
void BodyFilter::move_by(const Eigen::Matrix<double, kStates, 1>& error) noexcept {
  const Eigen::Quaterniond back = turned_by(-error.segment<3>(kTurn));
  attitude_ = (back * attitude_).normalized();
  velocity_m_s_ = back * (velocity_m_s_ - error.segment<3>(kSpeed));
  position_m_ = back * (position_m_ - error.segment<3>(kPlace));
  rate_bias_rad_s_ -= error.segment<3>(kRateBias);
  force_bias_m_s2_ -= error.segment<3>(kForceBias);
  sinks_m_N_ = std::clamp(sinks_m_N_ - error(kSinks), 0.0, kMostSinks_m_N);
  for (int i = 0; i < kLegs; ++i) {
    Foot& foot = feet_[static_cast<std::size_t>(i)];
    if (foot.anchored) foot.in_world_m = back * (foot.in_world_m - error.segment<3>(kFeet + 3 * i));
  }
}

Eigen::Matrix3d BodyFilter::attitude_covariance_rad2() const noexcept {
  return covariance_.block<3, 3>(kTurn, kTurn);
}

/// An error of a place is what is left when both are turned alike, less what the turn does to it.
Eigen::Matrix3d BodyFilter::velocity_covariance_m2_s2() const noexcept {
  Eigen::Matrix<double, 3, 6> by;
  by << -cross(velocity_m_s_), Eigen::Matrix3d::Identity();
  Eigen::Matrix3d out = by * covariance_.block<6, 6>(kTurn, kTurn) * by.transpose();
  const double share_m_s = kSpeedShare * velocity_m_s_.norm();
  out.diagonal().array() += share_m_s * share_m_s;
  return out;
}

Eigen::Matrix3d BodyFilter::place_covariance_m2() const noexcept {
  Eigen::Matrix<double, 3, kStates> by = Eigen::Matrix<double, 3, kStates>::Zero();
  by.block<3, 3>(0, kTurn) = -cross(position_m_);
  by.block<3, 3>(0, kPlace).setIdentity();
  return by * covariance_ * by.transpose();
}

Eigen::Matrix3d BodyFilter::position_covariance_m2() const noexcept {
  Eigen::Matrix3d out = place_covariance_m2();
  out.diagonal().array() += kWay * way_m_ * kWay * way_m_;
  return out;
}

}  // namespace sprung
