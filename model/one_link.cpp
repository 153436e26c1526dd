#include "model/one_link.h"

#include <cmath>

#include "model/leg_geometry.h"

namespace sprung {
namespace {

constexpr double kNearCircle_m = 1e-3;

}  // namespace

OneLink::OneLink(const LegConfig& leg) {
  require_of_leg(leg.joints.size() == 1, leg, kOneLink, "one joint");
  require_of_leg(leg.links.size() == 1, leg, kOneLink, "one link");
  arm_ = leg.links[0];
  require_of_leg(arm_.length_m > 0.0, leg, kOneLink, "a link of positive length");
}

LegPose OneLink::pose(const JointVector& position_rad) const noexcept {
  return {{}, sine_cosine(position_rad[0]), {}};
}

Eigen::Vector3d OneLink::foot_in_hip_m(const LegPose& pose) const noexcept {
  return {arm_.length_m * pose.thigh.sine, 0.0, -arm_.length_m * pose.thigh.cosine};
}

LegJacobian OneLink::jacobian(const LegPose& pose) const noexcept {
  LegJacobian j(3, 1);
  j << arm_.length_m * pose.thigh.cosine, 0.0, arm_.length_m * pose.thigh.sine;
  return j;
}

Eigen::Vector3d OneLink::last_link_rate_rad_s(const LegPose& /*pose*/,
                                              const JointVector& velocity_rad_s) const noexcept {
  return {0.0, -velocity_rad_s[0], 0.0};
}

Eigen::Vector3d OneLink::even_motion_acceleration_m_s2(const LegPose& pose,
                                                       const JointVector& velocity_rad_s) const noexcept {
  return -velocity_rad_s[0] * velocity_rad_s[0] * foot_in_hip_m(pose);
}

InverseResult OneLink::inverse(const Eigen::Vector3d& foot_in_hip_m,
                               const JointVector& near_rad) const noexcept {
  if (!foot_in_hip_m.allFinite()) return {near_rad, false};
  const double toward_rad = std::atan2(foot_in_hip_m.x(), -foot_in_hip_m.z());
  InverseResult out;
  out.position_rad = joint_vector(turned_toward(toward_rad, near_rad[0]));
  out.reachable = (foot_in_hip_m - this->foot_in_hip_m(out.position_rad)).norm() <= kNearCircle_m;
  return out;
}

JointVector OneLink::gravity_torque_Nm(const LegPose& pose) const noexcept {
  return joint_vector(arm_.mass_kg * kGravity_m_s2 * arm_.com_m * pose.thigh.sine);
}

JointVector OneLink::inverse_dynamics_Nm(const LegPose& pose, const JointVector& /*velocity_rad_s*/,
                                         const JointVector& acceleration_rad_s2) const noexcept {
  const double inertia_kg_m2 = arm_.inertia_kg_m2 + arm_.mass_kg * arm_.com_m * arm_.com_m;
  return joint_vector(inertia_kg_m2 * acceleration_rad_s2[0]) + gravity_torque_Nm(pose);
}

}  // namespace sprung
