#include "planner/fall_reflex.h"

#include <algorithm>
#include <cmath>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

// Tuned on pegasus, draws 1001 to 1064, pushes of 60 and 80 N s, for the force on the trunk:
// docs/locomotion.md.
constexpr double kFold_m_s = 3.0;   // as fast as the motors go
constexpr double kReach_m_s = 2.0;  // along the ground
constexpr double kLead_s = 0.4;     // of the body's speed, that a foot goes ahead
constexpr double kReach = 0.75;     // of a straight leg's length, at most
constexpr double kOver_rad = 2.2;   // on its back: until then legs soften how it rolls over its side
constexpr double kFolded = 1.1;     // of the length in which it sits: a way to spring in is left
/// Per mass of the robot: 3000 N/m and 150 N s/m of 30 kg.
constexpr double kStiffness_1_s2 = 100.0, kDamping_1_s = 5.0;
constexpr double kStiffnessAlong_1_s2 = 17.0, kDampingAlong_1_s = 2.0;

}  // namespace

void FallReflex::begin(const JointState& in, double folded_m, double straight_m) noexcept {
  active_ = true;
  began_us_ = in.stamp.utime_us;
  folded_m_ = kFolded * folded_m;
  farthest_m_ = kReach * straight_m;
  speed_m_s_.setZero();
  step(in);
  for (std::size_t i = 0; i < shape_.legs; ++i)
    from_m_[i] = level_from_trunk_ * to_eigen(in.legs[i].estimated_foot_in_hip_m);
  for (std::size_t i = 0; i < shape_.legs; ++i) active_ = active_ && from_m_[i].allFinite();
}

void FallReflex::step(const JointState& in) noexcept {
  if (!active_) return;
  const BodyView view = BodyView::of(in, shape_);
  const bool known = std::isfinite(in.body.estimated_quaternion_wxyz[0]);
  since_s_ = 1e-6 * static_cast<double>(in.stamp.utime_us - began_us_);
  if (known) level_from_trunk_ = view.level_from_trunk;
  if (view.velocity_known) speed_m_s_ = view.velocity_m_s.head<2>();
  const double tilt_rad = std::max(std::abs(view.attitude.roll_rad), std::abs(view.attitude.pitch_rad));
  active_ = since_s_ < kLasts_s && tilt_rad < kOver_rad;
}

void FallReflex::write(std::size_t leg, DesiredLeg& out) const noexcept {
  const Eigen::Vector3d& from_m = from_m_[leg];
  const Eigen::Vector2d lead_m = kLead_s * speed_m_s_;
  const double far_m = lead_m.norm();
  const Eigen::Vector2d place_m = shape_.foot_beside_hip_m[leg].head<2>() +
                                  (far_m > farthest_m_ ? farthest_m_ / far_m : 1.0) * lead_m;
  const Eigen::Vector2d way_m = place_m - from_m.head<2>();
  const double went_m = std::min(way_m.norm(), kReach_m_s * since_s_);
  Eigen::Vector3d foot_m = from_m;
  if (way_m.norm() > 0.0) foot_m.head<2>() += went_m / way_m.norm() * way_m;
  const double up_to_m = std::max(from_m.z(), -folded_m_);
  foot_m.z() = std::min(from_m.z() + kFold_m_s * since_s_, up_to_m);
  const Eigen::Vector3d speed_m_s(0.0, 0.0, foot_m.z() < up_to_m ? kFold_m_s : 0.0);
  const Eigen::Matrix3d trunk_from_level = level_from_trunk_.transpose();
  const double along_N_m = kStiffnessAlong_1_s2 * shape_.mass_kg, up_N_m = kStiffness_1_s2 * shape_.mass_kg;
  const double along_N_s_m = kDampingAlong_1_s * shape_.mass_kg, up_N_s_m = kDamping_1_s * shape_.mass_kg;
  out.desired_foot_in_hip_m = to_vec3(trunk_from_level * foot_m);
  out.desired_foot_velocity_m_s = to_vec3(trunk_from_level * speed_m_s);
  out.control_mode = ControlMode::kCompliance;
  out.stiffness_N_m = {along_N_m, along_N_m, up_N_m};
  out.damping_N_s_m = {along_N_s_m, along_N_s_m, up_N_s_m};
  out.velocity_feedforward = 1.0;
}

}  // namespace sprung
