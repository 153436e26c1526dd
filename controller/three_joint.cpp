#include "controller/three_joint.h"

#include <algorithm>
#include <cmath>

#include "controller/leg_geometry.h"

namespace sprung {
namespace {

constexpr double kInReach_m = 1e-9;

JointVector in_plane(const JointVector& of_leg) noexcept { return joint_vector(of_leg[1], of_leg[2]); }

/// Hip and knee of a three-joint leg alone.
LegConfig plane_of(const LegConfig& leg) {
  require_of_leg(leg.joints.size() == 3, leg, kThreeJoint, "three joints: abduction, hip, knee");
  require_of_leg(leg.links.size() == 3, leg, kThreeJoint, "three links: hip, thigh, shank");
  const bool long_enough = leg.links[1].length_m > 0.0 && leg.links[2].length_m > 0.0;
  require_of_leg(long_enough, leg, kThreeJoint, "thigh and shank of positive length");
  LegConfig plane = leg;
  plane.joints.erase(plane.joints.begin());
  plane.links.erase(plane.links.begin());
  return plane;
}

/// From the leg's plane to the trunk's axes, or the other way with the angle's sign changed.
Eigen::Vector3d abducted(double abduction_rad, const Eigen::Vector3d& v) noexcept {
  const double c = std::cos(abduction_rad);
  const double s = std::sin(abduction_rad);
  return {v.x(), c * v.y() - s * v.z(), s * v.y() + c * v.z()};
}

}  // namespace

/// Moment of inertia about the abduction axis and its derivatives by hip and knee.
struct ThreeJoint::RollInertia {
  double value_kg_m2 = 0.0;
  JointVector slope_kg_m2;
};

ThreeJoint::ThreeJoint(const LegConfig& leg) : plane_(plane_of(leg)) {
  const LinkConfig& hip = leg.links[0];
  thigh_ = leg.links[1];
  shank_ = leg.links[2];
  const double side = leg.side == LegSide::kLeft ? 1.0 : -1.0;
  const double below_kg = thigh_.mass_kg + shank_.mass_kg;
  offset_m_ = side * hip.length_m;
  lateral_moment_kg_m_ = side * hip.mass_kg * hip.com_m + below_kg * offset_m_;
  lateral_inertia_kg_m2_ =
      hip.inertia_kg_m2 + hip.mass_kg * hip.com_m * hip.com_m + below_kg * offset_m_ * offset_m_;
}

Eigen::Vector3d ThreeJoint::foot_in_hip_m(const JointVector& position_rad) const noexcept {
  Eigen::Vector3d foot = plane_.foot_in_hip_m(in_plane(position_rad));
  foot.y() = offset_m_;
  return abducted(position_rad[0], foot);
}

LegJacobian ThreeJoint::jacobian(const JointVector& position_rad) const noexcept {
  const LegJacobian plane = plane_.jacobian(in_plane(position_rad));
  LegJacobian j(3, 3);
  const Eigen::Vector3d foot = foot_in_hip_m(position_rad);
  j.col(0) = Eigen::Vector3d(0.0, -foot.z(), foot.y());
  j.col(1) = abducted(position_rad[0], plane.col(0));
  j.col(2) = abducted(position_rad[0], plane.col(1));
  return j;
}

Eigen::Vector2d ThreeJoint::nearest_in_reach_m(double forward_m, double from_axis_m) const noexcept {
  const double offset = std::abs(offset_m_);
  const double folded = std::abs(thigh_.length_m - shank_.length_m);
  const double straight = thigh_.length_m + shank_.length_m;
  const double distance = std::hypot(forward_m, from_axis_m);
  const double reached = std::clamp(distance, std::hypot(folded, offset), std::hypot(straight, offset));
  if (distance > 0.0) {
    const Eigen::Vector2d radial = Eigen::Vector2d(forward_m, from_axis_m) * (reached / distance);
    if (radial.y() >= offset) return radial;
  }
  return {std::copysign(std::clamp(std::abs(forward_m), folded, straight), forward_m), offset};
}

InverseResult ThreeJoint::inverse(const Eigen::Vector3d& foot_in_hip_m,
                                  const JointVector& near_rad) const noexcept {
  if (!foot_in_hip_m.allFinite()) return {near_rad, false};
  const Eigen::Vector2d wanted(foot_in_hip_m.x(), std::hypot(foot_in_hip_m.y(), foot_in_hip_m.z()));
  const Eigen::Vector2d foot = nearest_in_reach_m(wanted.x(), wanted.y());
  const double offset = std::abs(offset_m_);
  const double depth = std::sqrt(std::max(0.0, (foot.y() - offset) * (foot.y() + offset)));
  const double below = std::atan2(-depth, offset_m_);  // where the foot stands about the axis at no abduction
  const bool on_axis = wanted.y() < kInReach_m;        // any abduction will do
  const double about_axis = on_axis ? near_rad[0] + below : std::atan2(foot_in_hip_m.z(), foot_in_hip_m.y());
  const double with_foot_below = turned_toward(about_axis - below, near_rad[0]);
  const double with_foot_above = turned_toward(about_axis + below, near_rad[0]);
  const bool above = std::abs(with_foot_above - near_rad[0]) < std::abs(with_foot_below - near_rad[0]);
  const InverseResult plane =
      plane_.inverse({foot.x(), 0.0, above ? depth : -depth}, joint_vector(near_rad[1], near_rad[2]));
  InverseResult out;
  out.position_rad =
      joint_vector(above ? with_foot_above : with_foot_below, plane.position_rad[0], plane.position_rad[1]);
  out.reachable = (foot - wanted).norm() <= kInReach_m;
  return out;
}

JointVector ThreeJoint::gravity_torque_Nm(const JointVector& position_rad) const noexcept {
  const JointVector plane_rad = in_plane(position_rad);
  const double c = std::cos(position_rad[0]);
  const double s = std::sin(position_rad[0]);
  const JointVector plane = plane_.weight_torque_Nm(plane_rad, kGravity_m_s2 * c);
  const double left_kg_m = c * lateral_moment_kg_m_ - s * plane_.mass_moment_kg_m(plane_rad);
  return joint_vector(kGravity_m_s2 * left_kg_m, plane[0], plane[1]);
}

ThreeJoint::RollInertia ThreeJoint::roll_inertia(const JointVector& in_plane_rad) const noexcept {
  const double thigh = in_plane_rad[0];
  const double shank = in_plane_rad[0] - in_plane_rad[1];
  const double thigh_kg_m2 = thigh_.inertia_kg_m2 + thigh_.mass_kg * thigh_.com_m * thigh_.com_m;
  const double shank_depth_m = thigh_.length_m * std::sin(thigh) + shank_.com_m * std::sin(shank);
  const double by_thigh = 2.0 * std::cos(thigh) *
                          (thigh_kg_m2 * std::sin(thigh) + shank_.mass_kg * shank_depth_m * thigh_.length_m);
  const double by_shank =
      2.0 * std::cos(shank) *
      (shank_.inertia_kg_m2 * std::sin(shank) + shank_.mass_kg * shank_depth_m * shank_.com_m);
  RollInertia out;
  out.value_kg_m2 = lateral_inertia_kg_m2_ + thigh_kg_m2 * std::sin(thigh) * std::sin(thigh) +
                    shank_.inertia_kg_m2 * std::sin(shank) * std::sin(shank) +
                    shank_.mass_kg * shank_depth_m * shank_depth_m;
  out.slope_kg_m2 = joint_vector(by_thigh + by_shank, -by_shank);
  return out;
}

JointVector ThreeJoint::inverse_dynamics_Nm(const JointVector& position_rad,
                                            const JointVector& velocity_rad_s,
                                            const JointVector& acceleration_rad_s2) const noexcept {
  const JointVector q = in_plane(position_rad);
  const JointVector w = in_plane(velocity_rad_s);
  const JointVector a = in_plane(acceleration_rad_s2);
  const double roll_rad_s = velocity_rad_s[0];
  const double roll_rad_s2 = acceleration_rad_s2[0];
  const RollInertia inertia = roll_inertia(q);
  const JointVector plane = plane_.motion_torque_Nm(q, w, a) +
                            offset_m_ * roll_rad_s2 * plane_.weight_torque_Nm(q, 1.0) -
                            0.5 * roll_rad_s * roll_rad_s * inertia.slope_kg_m2;
  const double roll_Nm = inertia.value_kg_m2 * roll_rad_s2 + roll_rad_s * inertia.slope_kg_m2.dot(w) +
                         offset_m_ * plane_.mass_moment_acceleration_N(q, w, a);
  return joint_vector(roll_Nm, plane[0], plane[1]) + gravity_torque_Nm(position_rad);
}

double ThreeJoint::potential_energy_J(const JointVector& position_rad) const noexcept {
  return kGravity_m_s2 * (std::sin(position_rad[0]) * lateral_moment_kg_m_ +
                          std::cos(position_rad[0]) * plane_.mass_moment_kg_m(in_plane(position_rad)));
}

}  // namespace sprung
