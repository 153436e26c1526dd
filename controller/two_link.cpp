#include "controller/two_link.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInPlane_m = 1e-6;
constexpr double kAtHip_m = 1e-9;  // direction of the foot is undefined closer than this

void require(bool ok, const LegConfig& leg, const char* what) {
  if (!ok) throw std::invalid_argument("leg '" + leg.name + "': two_link needs " + what);
}

/// arccos of a cosine law, clamped; `inside` becomes false when it had to be.
double clamped_acos(double cosine, bool& inside) noexcept {
  constexpr double kRounding = 1e-12;
  inside = inside && std::abs(cosine) <= 1.0 + kRounding;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double turned_toward(double angle_rad, double near_rad) noexcept {
  return angle_rad + 2.0 * kPi * std::round((near_rad - angle_rad) / (2.0 * kPi));
}

JointVector pair(double hip, double knee) noexcept {
  JointVector v(2);
  v << hip, knee;
  return v;
}

}  // namespace

TwoLink::TwoLink(const LegConfig& leg) {
  require(leg.joints.size() == 2, leg, "two joints: hip, knee");
  require(leg.links.size() == 2, leg, "two links: thigh, shank");
  thigh_ = leg.links[0];
  shank_ = leg.links[1];
  require(thigh_.length_m > 0.0 && shank_.length_m > 0.0, leg, "links of positive length");
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
  const double l1 = thigh_.length_m;
  const double l2 = shank_.length_m;
  const double r = std::max(std::hypot(foot_in_hip_m.x(), foot_in_hip_m.z()), kAtHip_m);
  bool reachable = std::abs(foot_in_hip_m.y()) <= kInPlane_m;
  const double between_links = clamped_acos((l1 * l1 + l2 * l2 - r * r) / (2.0 * l1 * l2), reachable);
  bool unused = true;
  const double thigh_to_foot = clamped_acos((l1 * l1 + r * r - l2 * l2) / (2.0 * l1 * r), unused);
  const double foot_direction = std::atan2(-foot_in_hip_m.z(), foot_in_hip_m.x());  // E3, positive downward
  const double side = near_rad[1] >= 0.0 ? 1.0 : -1.0;                              // E4: both branches
  InverseResult out;
  out.position_rad =
      pair(turned_toward(foot_direction + side * thigh_to_foot, near_rad[0]), side * (kPi - between_links));
  out.reachable = reachable && std::isfinite(r);
  return out;
}

JointVector TwoLink::gravity_torque_Nm(const JointVector& position_rad) const noexcept {
  const double c1 = std::cos(position_rad[0]);
  const double c12 = std::cos(position_rad[0] - position_rad[1]);
  const double knee = shank_.mass_kg * kGravity_m_s2 * shank_.com_m * c12;
  const double thigh =
      (thigh_.mass_kg * thigh_.com_m + shank_.mass_kg * thigh_.length_m) * kGravity_m_s2 * c1;
  return pair(-(thigh + knee), knee);
}

JointVector TwoLink::inverse_dynamics_Nm(const JointVector& position_rad, const JointVector& velocity_rad_s,
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
  const JointVector gravity = gravity_torque_Nm(position_rad);
  return pair(m11 * a1 + m12 * a2 + coupling * s2 * w2 * (w2 - 2.0 * w1) + gravity[0],
              m12 * a1 + m22 * a2 + coupling * s2 * w1 * w1 + gravity[1]);
}

double TwoLink::potential_energy_J(const JointVector& position_rad) const noexcept {
  const double s1 = std::sin(position_rad[0]);
  const double s12 = std::sin(position_rad[0] - position_rad[1]);
  return -kGravity_m_s2 *
         (thigh_.mass_kg * thigh_.com_m * s1 + shank_.mass_kg * (thigh_.length_m * s1 + shank_.com_m * s12));
}

}  // namespace sprung
