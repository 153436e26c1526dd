#include "model/two_link.h"

#include <algorithm>
#include <cmath>

#include "model/leg_geometry.h"
#include "signals/angles.h"

namespace sprung {
namespace {

constexpr double kInPlane_m = 1e-6;
constexpr double kAtHip_m = 1e-9;  // direction of the foot is undefined closer than this

/// arccos of a cosine law, clamped; `inside` becomes false when it had to be.
double clamped_acos(double cosine, bool& inside) noexcept {
  constexpr double kRounding = 1e-12;
  inside = inside && std::abs(cosine) <= 1.0 + kRounding;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Of the angle a less b.
SineCosine between(const SineCosine& a, const SineCosine& b) noexcept {
  return {a.sine * b.cosine - a.cosine * b.sine, a.cosine * b.cosine + a.sine * b.sine};
}

}  // namespace

TwoLink::TwoLink(const LegConfig& leg) {
  require_of_leg(leg.joints.size() == 2, leg, kTwoLink, "two joints: hip, knee");
  require_of_leg(leg.links.size() == 2, leg, kTwoLink, "two links: thigh, shank");
  thigh_ = leg.links[0];
  shank_ = leg.links[1];
  require_of_leg(thigh_.length_m > 0.0 && shank_.length_m > 0.0, leg, kTwoLink, "links of positive length");
  thigh_moment_kg_m_ = thigh_.mass_kg * thigh_.com_m + shank_.mass_kg * thigh_.length_m;
  shank_moment_kg_m_ = shank_.mass_kg * shank_.com_m;
}

LegPose TwoLink::pose(const JointVector& position_rad) const noexcept {
  return {{}, sine_cosine(position_rad[0]), sine_cosine(position_rad[0] - position_rad[1])};
}

Eigen::Vector3d TwoLink::foot_in_hip_m(const LegPose& pose) const noexcept {
  return {thigh_.length_m * pose.thigh.cosine + shank_.length_m * pose.shank.cosine, 0.0,
          -(thigh_.length_m * pose.thigh.sine + shank_.length_m * pose.shank.sine)};
}

LegJacobian TwoLink::jacobian(const LegPose& pose) const noexcept {
  const double l1s1 = thigh_.length_m * pose.thigh.sine;
  const double l1c1 = thigh_.length_m * pose.thigh.cosine;
  const double l2s12 = shank_.length_m * pose.shank.sine;
  const double l2c12 = shank_.length_m * pose.shank.cosine;
  LegJacobian j(3, 2);
  j << -l1s1 - l2s12, l2s12, 0.0, 0.0, -l1c1 - l2c12, l2c12;
  return j;
}

Eigen::Vector3d TwoLink::last_link_rate_rad_s(const LegPose& /*pose*/,
                                              const JointVector& velocity_rad_s) const noexcept {
  return {0.0, velocity_rad_s[0] - velocity_rad_s[1], 0.0};
}

Eigen::Vector3d TwoLink::even_motion_acceleration_m_s2(const LegPose& pose,
                                                       const JointVector& velocity_rad_s) const noexcept {
  const double shank_rad_s = velocity_rad_s[0] - velocity_rad_s[1];
  const double thigh_m_s2 = thigh_.length_m * velocity_rad_s[0] * velocity_rad_s[0];  // toward the hip
  const double shank_m_s2 = shank_.length_m * shank_rad_s * shank_rad_s;              // toward the knee
  return {-thigh_m_s2 * pose.thigh.cosine - shank_m_s2 * pose.shank.cosine, 0.0,
          thigh_m_s2 * pose.thigh.sine + shank_m_s2 * pose.shank.sine};
}

InverseResult TwoLink::inverse(const Eigen::Vector3d& foot_in_hip_m,
                               const JointVector& near_rad) const noexcept {
  if (!foot_in_hip_m.allFinite()) return {near_rad, false};
  const double l1 = thigh_.length_m;
  const double l2 = shank_.length_m;
  const double distance_m = std::hypot(foot_in_hip_m.x(), foot_in_hip_m.z());
  const double r = std::max(distance_m, kAtHip_m);
  bool reachable = std::abs(foot_in_hip_m.y()) <= kInPlane_m;
  const double between_links = clamped_acos((l1 * l1 + l2 * l2 - r * r) / (2.0 * l1 * l2), reachable);
  bool unused = true;
  const double thigh_to_foot = clamped_acos((l1 * l1 + r * r - l2 * l2) / (2.0 * l1 * r), unused);
  const double foot_direction = std::atan2(-foot_in_hip_m.z(), foot_in_hip_m.x());  // E3, positive downward
  const double side = near_rad[1] >= 0.0 ? 1.0 : -1.0;                              // E4: both branches
  const double hip = distance_m < kAtHip_m ? near_rad[0] : foot_direction + side * thigh_to_foot;
  InverseResult out;
  out.position_rad = joint_vector(turned_toward(hip, near_rad[0]), side * (kPi - between_links));
  out.reachable = reachable;
  return out;
}

Eigen::Vector2d TwoLink::weight_torque_Nm(const LegPose& pose, double gravity_m_s2) const noexcept {
  const double knee = shank_moment_kg_m_ * gravity_m_s2 * pose.shank.cosine;
  const double thigh = thigh_moment_kg_m_ * gravity_m_s2 * pose.thigh.cosine;
  return {-(thigh + knee), knee};
}

JointVector TwoLink::gravity_torque_Nm(const LegPose& pose) const noexcept {
  return weight_torque_Nm(pose, kGravity_m_s2);
}

Eigen::Vector2d TwoLink::motion_torque_Nm(const LegPose& pose, const Eigen::Vector2d& velocity_rad_s,
                                          const Eigen::Vector2d& acceleration_rad_s2) const noexcept {
  const double coupling = shank_.mass_kg * thigh_.length_m * shank_.com_m;
  const SineCosine knee = between(pose.thigh, pose.shank);
  const double m22 = shank_.inertia_kg_m2 + shank_.mass_kg * shank_.com_m * shank_.com_m;
  const double m12 = -(m22 + coupling * knee.cosine);
  const double m11 = thigh_.inertia_kg_m2 + thigh_.mass_kg * thigh_.com_m * thigh_.com_m + m22 +
                     shank_.mass_kg * thigh_.length_m * thigh_.length_m + 2.0 * coupling * knee.cosine;
  const double w1 = velocity_rad_s[0];
  const double w2 = velocity_rad_s[1];
  const double a1 = acceleration_rad_s2[0];
  const double a2 = acceleration_rad_s2[1];
  return {m11 * a1 + m12 * a2 + coupling * knee.sine * w2 * (w2 - 2.0 * w1),
          m12 * a1 + m22 * a2 + coupling * knee.sine * w1 * w1};
}

JointVector TwoLink::inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                         const JointVector& acceleration_rad_s2) const noexcept {
  return motion_torque_Nm(pose, velocity_rad_s.head<2>(), acceleration_rad_s2.head<2>()) +
         weight_torque_Nm(pose, kGravity_m_s2);
}

double TwoLink::mass_moment_kg_m(const LegPose& pose) const noexcept {
  return -(thigh_moment_kg_m_ * pose.thigh.sine + shank_moment_kg_m_ * pose.shank.sine);
}

double TwoLink::mass_moment_acceleration_N(const LegPose& pose, const Eigen::Vector2d& velocity_rad_s,
                                           const Eigen::Vector2d& acceleration_rad_s2) const noexcept {
  const double w_thigh = velocity_rad_s[0];
  const double w_shank = velocity_rad_s[0] - velocity_rad_s[1];
  const double a_thigh = acceleration_rad_s2[0];
  const double a_shank = acceleration_rad_s2[0] - acceleration_rad_s2[1];
  return thigh_moment_kg_m_ * (pose.thigh.sine * w_thigh * w_thigh - pose.thigh.cosine * a_thigh) +
         shank_moment_kg_m_ * (pose.shank.sine * w_shank * w_shank - pose.shank.cosine * a_shank);
}

double TwoLink::potential_energy_J(const JointVector& position_rad) const noexcept {
  return kGravity_m_s2 * mass_moment_kg_m(pose(position_rad));
}

}  // namespace sprung
