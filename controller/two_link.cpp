#include "controller/two_link.h"

#include <algorithm>
#include <cmath>

#include "controller/leg_geometry.h"

namespace sprung {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInPlane_m = 1e-6;
constexpr double kAtHip_m = 1e-9;  // direction of the foot is undefined closer than this

/// arccos of a cosine law, clamped; `inside` becomes false when it had to be.
double clamped_acos(double cosine, bool& inside) noexcept {
  constexpr double kRounding = 1e-12;
  inside = inside && std::abs(cosine) <= 1.0 + kRounding;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

TwoLink::TwoLink(const LegConfig& leg) {
  require_of_leg(leg.joints.size() == 2, leg, kTwoLink, "two joints: hip, knee");
  require_of_leg(leg.links.size() == 2, leg, kTwoLink, "two links: thigh, shank");
  thigh_ = leg.links[0];
  shank_ = leg.links[1];
  require_of_leg(thigh_.length_m > 0.0 && shank_.length_m > 0.0, leg, kTwoLink, "links of positive length");
}

Eigen::Vector3d TwoLink::foot_in_hip_m(const JointVector& position_rad) const noexcept {
  const double thigh_angle = position_rad[0];
  const double shank_angle = position_rad[0] - position_rad[1];
  return {thigh_.length_m * std::cos(thigh_angle) + shank_.length_m * std::cos(shank_angle), 0.0,
          -(thigh_.length_m * std::sin(thigh_angle) + shank_.length_m * std::sin(shank_angle))};
}

LegJacobian TwoLink::jacobian(const JointVector& position_rad) const noexcept {
  const double shank_angle = position_rad[0] - position_rad[1];
  const double l1s1 = thigh_.length_m * std::sin(position_rad[0]);
  const double l1c1 = thigh_.length_m * std::cos(position_rad[0]);
  const double l2s12 = shank_.length_m * std::sin(shank_angle);
  const double l2c12 = shank_.length_m * std::cos(shank_angle);
  LegJacobian j(3, 2);
  j << -l1s1 - l2s12, l2s12, 0.0, 0.0, -l1c1 - l2c12, l2c12;
  return j;
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

JointVector TwoLink::weight_torque_Nm(const JointVector& position_rad, double gravity_m_s2) const noexcept {
  const double c1 = std::cos(position_rad[0]);
  const double c12 = std::cos(position_rad[0] - position_rad[1]);
  const double knee = shank_.mass_kg * gravity_m_s2 * shank_.com_m * c12;
  const double thigh = (thigh_.mass_kg * thigh_.com_m + shank_.mass_kg * thigh_.length_m) * gravity_m_s2 * c1;
  return joint_vector(-(thigh + knee), knee);
}

JointVector TwoLink::gravity_torque_Nm(const JointVector& position_rad) const noexcept {
  return weight_torque_Nm(position_rad, kGravity_m_s2);
}

JointVector TwoLink::motion_torque_Nm(const JointVector& position_rad, const JointVector& velocity_rad_s,
                                      const JointVector& acceleration_rad_s2) const noexcept {
  const double coupling = shank_.mass_kg * thigh_.length_m * shank_.com_m;
  const double c2 = std::cos(position_rad[1]);
  const double s2 = std::sin(position_rad[1]);
  const double m22 = shank_.inertia_kg_m2 + shank_.mass_kg * shank_.com_m * shank_.com_m;
  const double m12 = -(m22 + coupling * c2);
  const double m11 = thigh_.inertia_kg_m2 + thigh_.mass_kg * thigh_.com_m * thigh_.com_m + m22 +
                     shank_.mass_kg * thigh_.length_m * thigh_.length_m + 2.0 * coupling * c2;
  const double w1 = velocity_rad_s[0];
  const double w2 = velocity_rad_s[1];
  const double a1 = acceleration_rad_s2[0];
  const double a2 = acceleration_rad_s2[1];
  return joint_vector(m11 * a1 + m12 * a2 + coupling * s2 * w2 * (w2 - 2.0 * w1),
                      m12 * a1 + m22 * a2 + coupling * s2 * w1 * w1);
}

JointVector TwoLink::inverse_dynamics_Nm(const JointVector& position_rad, const JointVector& velocity_rad_s,
                                         const JointVector& acceleration_rad_s2) const noexcept {
  return motion_torque_Nm(position_rad, velocity_rad_s, acceleration_rad_s2) +
         gravity_torque_Nm(position_rad);
}

double TwoLink::mass_moment_kg_m(const JointVector& position_rad) const noexcept {
  const double s1 = std::sin(position_rad[0]);
  const double s12 = std::sin(position_rad[0] - position_rad[1]);
  return -(thigh_.mass_kg * thigh_.com_m * s1 + shank_.mass_kg * (thigh_.length_m * s1 + shank_.com_m * s12));
}

double TwoLink::mass_moment_acceleration_N(const JointVector& position_rad, const JointVector& velocity_rad_s,
                                           const JointVector& acceleration_rad_s2) const noexcept {
  const double thigh_kg_m = thigh_.mass_kg * thigh_.com_m + shank_.mass_kg * thigh_.length_m;
  const double shank_kg_m = shank_.mass_kg * shank_.com_m;
  const double thigh = position_rad[0];
  const double shank = position_rad[0] - position_rad[1];
  const double w_thigh = velocity_rad_s[0];
  const double w_shank = velocity_rad_s[0] - velocity_rad_s[1];
  const double a_thigh = acceleration_rad_s2[0];
  const double a_shank = acceleration_rad_s2[0] - acceleration_rad_s2[1];
  return thigh_kg_m * (std::sin(thigh) * w_thigh * w_thigh - std::cos(thigh) * a_thigh) +
         shank_kg_m * (std::sin(shank) * w_shank * w_shank - std::cos(shank) * a_shank);
}

double TwoLink::potential_energy_J(const JointVector& position_rad) const noexcept {
  return kGravity_m_s2 * mass_moment_kg_m(position_rad);
}

}  // namespace sprung
