#include "estimator/standing_feet.h"

#include <algorithm>
#include <cmath>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

/// In which a foot that has come down gains its weight: an impact on 60 kN/m rings for less.
constexpr double kFootSettling_s = 0.03;
/// A foot counts fully from this many times the contact threshold on.
constexpr double kLoaded = 2.0;
constexpr double kCounts = 0.5;
/// Spread of the feet below which they say nothing of a rotation; pegasus' stand 0.7 x 0.35 m apart.
constexpr double kLeastSpread_m = 0.03;

}  // namespace

StandingFeet::StandingFeet(const std::vector<LegConfig>& legs) : feet_(legs.size()) {
  for (const LegConfig& leg : legs)
    legs_.push_back(
        {to_eigen(leg.hip_in_trunk_m), std::max(1.0, kLoaded * leg.contact_on_N), leg.foot_radius_m});
}

void StandingFeet::reset() noexcept {
  for (Leg& leg : legs_) leg.since_s = 0.0;
  for (StandingFoot& foot : feet_) foot = StandingFoot{};
  weight_ = 0.0;
}

void StandingFeet::update(const std::vector<EstimatedLeg>& legs,
                          const std::vector<Eigen::Vector3d>& last_link_rates_rad_s, double dt_s) noexcept {
  for (std::size_t i = 0; i < legs_.size() && i < legs.size(); ++i)
    update_foot(legs_[i], legs[i], last_link_rates_rad_s[i], dt_s, feet_[i]);
  find_middle();
}

void StandingFeet::update_foot(Leg& leg, const EstimatedLeg& estimated,
                               const Eigen::Vector3d& link_rate_rad_s, double dt_s,
                               StandingFoot& foot) const noexcept {
  foot.in_trunk_m = leg.hip_in_trunk_m + to_eigen(estimated.estimated_foot_in_hip_m);
  foot.velocity_m_s = to_eigen(estimated.estimated_foot_velocity_m_s);
  foot.link_rate_rad_s = link_rate_rad_s;
  foot.radius_m = leg.radius_m;
  foot.load_N = estimated.foot_force_N[2];
  const double load = estimated.foot_force_N[2] / leg.loaded_N;
  const bool known = foot.in_trunk_m.allFinite() && foot.velocity_m_s.allFinite() &&
                     link_rate_rad_s.allFinite() && std::isfinite(load);
  if (!known || !estimated.contact) {
    leg.since_s = 0.0;
    foot = StandingFoot{};
    return;
  }
  leg.since_s = std::min(kFootSettling_s, leg.since_s + dt_s);
  foot.weight = leg.since_s / kFootSettling_s * std::clamp(load, 0.0, 1.0) *
                std::clamp(estimated.contact_confidence, 0.0, 1.0);
}

void StandingFeet::find_middle() noexcept {
  weight_ = 0.0;
  middle_m_.setZero();
  middle_velocity_m_s_.setZero();
  for (const StandingFoot& foot : feet_) {
    weight_ += foot.weight;
    middle_m_ += foot.weight * foot.in_trunk_m;
    middle_velocity_m_s_ += foot.weight * foot.velocity_m_s;
  }
  if (weight_ <= 0.0) return;
  middle_m_ /= weight_;
  middle_velocity_m_s_ /= weight_;
}

int StandingFeet::count() const noexcept {
  return static_cast<int>(
      std::count_if(feet_.begin(), feet_.end(), [](const StandingFoot& f) { return f.weight >= kCounts; }));
}

/// A foot that stays where it is moves with -w x p as seen from a trunk that turns with w: least squares over
/// the feet.
Eigen::Vector3d StandingFeet::angular_velocity_rad_s() const noexcept {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity() * (kLeastSpread_m * kLeastSpread_m);
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (const StandingFoot& foot : feet_) {
    const Eigen::Vector3d p = foot.in_trunk_m - middle_m_;
    inertia += foot.weight * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
    momentum -= foot.weight * p.cross(foot.velocity_m_s - middle_velocity_m_s_);
  }
  return inertia.inverse() * momentum;
}

/// Turning by d lifts a foot at r by dx ry - dy rx: least squares for feet of one height.
Eigen::Vector3d StandingFeet::tilt_error_rad(const Eigen::Quaterniond& trunk_to_world) const noexcept {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Identity() * (kLeastSpread_m * kLeastSpread_m);
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();
  for (const StandingFoot& foot : feet_) {
    const Eigen::Vector3d r = trunk_to_world * (foot.in_trunk_m - middle_m_);
    const Eigen::Vector2d lever(r.y(), -r.x());
    spread += foot.weight * lever * lever.transpose();
    rise -= foot.weight * r.z() * lever;
  }
  const Eigen::Vector2d turn = spread.inverse() * rise;
  return {turn.x(), turn.y(), 0.0};
}

double StandingFeet::height_m(const Eigen::Quaterniond& trunk_to_world) const noexcept {
  return weight_ > 0.0 ? -(trunk_to_world * middle_m_).z() : kNaN;
}

}  // namespace sprung
