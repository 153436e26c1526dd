#include <algorithm>

#include "model/leg_kinematics.h"
#include "planner/gait/walk.h"

/// The body of a walk over the ground, and where feet belong under it.
namespace sprung {
namespace {

constexpr double kLeans_m = 0.03;  // [design choice] of a body that is not over the middle of its feet
/// [design choice] Of a body's speed from the wanted one, what its springs lag and sway by: feet set by that
/// would be behind in every step, and the walk slower.
constexpr double kPushed_m_s = 0.06;
constexpr double kCarefulFor_s = 15.0;   // [design choice] four rounds of a crawl
constexpr double kHeightGain_1_s = 3.0;  // in which the feet's places follow the wanted height

/// What of a vector is longer than that.
Eigen::Vector2d beyond(const Eigen::Vector2d& v, double least) noexcept {
  const double length = v.norm();
  return length > least ? Eigen::Vector2d(v * (1.0 - least / length)) : Eigen::Vector2d::Zero();
}

BodyWrench turned(const Eigen::Matrix3d& by, const BodyWrench& wrench) noexcept {
  return {by * wrench.force_N, by * wrench.torque_Nm};
}

}  // namespace

void Walk::lean(double dt_s) noexcept {
  const Eigen::Vector2d speed_m_s = pace_.now() * Eigen::Vector2d(pace_.speed()[0], pace_.speed()[1]);
  careful_s_ = std::max(0.0, careful_s_ - dt_s);
  for (std::size_t i = 0; i < shape_.legs; ++i)
    if (steps_[i].held_up()) careful_s_ = kCarefulFor_s;
  weight_.be_careful(careful_s_ > 0.0);
  weight_.step(clock_, view_, speed_m_s, dt_s);
  if (weight_.gave_up()) fail("the body cannot be brought over three feet");
  const Eigen::Vector2d over_ground_m_s = speed_m_s + weight_.speed_m_s();
  body_m_s_ << over_ground_m_s, ground_.slope().dot(over_ground_m_s);
}

/// Of the body from the middle of its feet's places, before it walks; a gait that does not lean begins as it
/// is.
Eigen::Vector2d Walk::leaning_m() const noexcept {
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < shape_.legs; ++i) sum_m += (under_hip_m(i) - view_.foot_m[i]).head<2>();
  const Eigen::Vector2d lean_m = sum_m / static_cast<double>(shape_.legs);
  const double far_m = lean_m.norm(), most_m = gait().sway_m;
  if (!(far_m > kLeans_m)) return Eigen::Vector2d::Zero();
  return far_m > most_m ? Eigen::Vector2d(lean_m * (most_m / far_m)) : lean_m;
}

/// Where a leg hangs plumb from its hip, whatever the trunk's attitude.
Eigen::Vector3d Walk::under_hip_m(std::size_t leg) const noexcept {
  return level_from_ground_ * shape_.hip_in_trunk_m[leg] + shape_.foot_beside_hip_m[leg];
}

Eigen::Vector3d Walk::place_m(std::size_t leg) const noexcept {
  Eigen::Vector3d place = under_hip_m(leg);
  place.y() += shape_.side[leg] * width_m_;
  place.head<2>() -= weight_.at_m() + heat_lean_.at_m();
  place.z() = ground_.z_m(place);
  return place;
}

/// Half a stance ahead of its place, and further where the body is faster than it should be.
Eigen::Vector3d Walk::foothold_m(std::size_t leg) const noexcept {
  const Eigen::Vector3d place = place_m(leg);
  const Eigen::Vector3d turning(0.0, 0.0, pace_.speed()[2]);
  const Eigen::Vector3d speed(pace_.speed()[0], pace_.speed()[1], 0.0);
  Eigen::Vector3d out = place + lead_s_ * (speed + turning.cross(place));
  if (view_.velocity_known) {
    constexpr double kFarthest_m = 0.1;
    Eigen::Vector2d beyond_m = law_.foothold_gain_s *
                               beyond((view_.velocity_m_s - body_m_s_).head<2>(), kPushed_m_s);
    if (beyond_m.norm() > kFarthest_m) beyond_m *= kFarthest_m / beyond_m.norm();
    out.head<2>() += beyond_m;
  }
  out.z() = ground_.expected_z_m(out);
  return out;
}

GroundPlane::Feet Walk::ground_feet() const noexcept {
  GroundPlane::Feet feet{};
  for (std::size_t i = 0; i < shape_.legs; ++i) feet[i] = {view_.foot_m[i], steps_[i].stands()};
  return feet;
}

void Walk::follow_ground(double dt_s) noexcept {
  ground_.follow(ground_feet(), view_.attitude.yaw_rad, gait().period_s, dt_s);
  lie_along_ground();
}

void Walk::lie_along_ground() noexcept {
  trunk_ = attitude_along(ground_.slope());
  level_from_ground_ = sprung::level_from_trunk(trunk_);
}

/// The feet that stand follow the wanted height together; how they differ is the ground's doing.
void Walk::hold_height(double dt_s) noexcept {
  double wanted_m = 0.0;
  int feet = 0;
  for (std::size_t i = 0; i < shape_.legs; ++i) {
    if (!steps_[i].stands()) continue;
    wanted_m += steps_[i].wanted_m().z() - ground_.slope().dot(steps_[i].wanted_m().head<2>());
    ++feet;
  }
  if (feet == 0) return;
  const double by_m = (-height_m_ - wanted_m / feet) * std::min(1.0, kHeightGain_1_s * dt_s);
  for (std::size_t i = 0; i < shape_.legs; ++i)
    if (steps_[i].stands()) steps_[i].shift({0.0, 0.0, by_m});
}

/// Share of its load that a standing foot takes: growing after it landed, shrinking before it leaves.
double Walk::load(std::size_t leg) const noexcept {
  if (!steps_[leg].stands()) return 0.0;
  if (law_.force_rise_s <= 0.0) return 1.0;
  const double since = steps_[leg].in_phase_s() / law_.force_rise_s;
  const double until = clock_.until_swing_s(leg) / law_.force_rise_s;
  return std::clamp(std::min(since, until), 0.0, 1.0);
}

void Walk::share_weight() noexcept {
  for (Eigen::Vector3d& force : force_N_) force.setZero();
  if (!law_.distribute_force) return;
  const BodyWish wish{body_m_s_, turning_rad_s_, trunk_, height_m_, -ground_.z_m()};
  const Eigen::Matrix3d ground_from_level = level_from_ground_.transpose();
  for (std::size_t i = 0; i < shape_.legs; ++i)
    feet_[i] = {ground_from_level * (view_.foot_m[i] - view_.com_m), load(i) * shape_.mass_kg * kGravity_m_s2,
                0.0, steps_[i].stands()};
  const BodyWrench wanted = turned(ground_from_level, wanted_wrench(law_, shape_, view_, wish));
  const DistributedForce& shared = distribution_.solve(wanted, feet_);
  for (std::size_t i = 0; i < shape_.legs; ++i) force_N_[i] = level_from_ground_ * shared.ground_on_foot_N[i];
}

}  // namespace sprung
