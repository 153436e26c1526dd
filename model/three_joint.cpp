#include "model/three_joint.h"

#include <algorithm>
#include <cmath>

#include "model/leg_geometry.h"

namespace sprung {
namespace {

constexpr double kInReach_m = 1e-9;

Eigen::Vector2d in_plane(const JointVector& of_leg) noexcept { return of_leg.segment<2>(1); }

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

/// From the leg's plane to the trunk's axes.
Eigen::Vector3d abducted(const SineCosine& abduction, const Eigen::Vector3d& v) noexcept {
  return {v.x(), abduction.cosine * v.y() - abduction.sine * v.z(),
          abduction.sine * v.y() + abduction.cosine * v.z()};
}

}  // namespace

/// Moment of inertia about the abduction axis and its derivatives by hip and knee.
struct ThreeJoint::RollInertia {
  double value_kg_m2;
  Eigen::Vector2d slope_kg_m2;
};

ThreeJoint::ThreeJoint(const LegConfig& leg) : plane_(plane_of(leg)) {
  const LinkConfig& hip = leg.links[0];
  thigh_ = leg.links[1];
  shank_ = leg.links[2];
  const double side = leg.side == LegSide::kLeft ? 1.0 : -1.0;
  const double below_kg = thigh_.mass_kg + shank_.mass_kg;
  offset_m_ = side * hip.length_m;
  lateral_moment_kg_m_ = side * hip.mass_kg * hip.com_m + below_kg * offset_m_;
  lateral_inertia_kg_m2_ = hip.inertia_kg_m2 + hip.mass_kg * hip.com_m * hip.com_m +
                           below_kg * offset_m_ * offset_m_;
  nearest_m_ = std::hypot(thigh_.length_m - shank_.length_m, offset_m_);
  farthest_m_ = std::hypot(thigh_.length_m + shank_.length_m, offset_m_);
}

LegPose ThreeJoint::pose(const JointVector& position_rad) const noexcept {
  LegPose pose = plane_.pose(in_plane(position_rad));
  pose.abduction = sine_cosine(position_rad[0]);
  return pose;
}

Eigen::Vector3d ThreeJoint::foot_in_hip_m(const LegPose& pose) const noexcept {
  Eigen::Vector3d foot = plane_.foot_in_hip_m(pose);
  foot.y() = offset_m_;
  return abducted(pose.abduction, foot);
}

LegJacobian ThreeJoint::jacobian(const LegPose& pose) const noexcept {
  const LegJacobian plane = plane_.jacobian(pose);
  const Eigen::Vector3d foot = foot_in_hip_m(pose);
  Eigen::Matrix3d j;
  j.col(0) << 0.0, -foot.z(), foot.y();
  j.col(1) = abducted(pose.abduction, plane.col(0));
  j.col(2) = abducted(pose.abduction, plane.col(1));
  return j;
}

Eigen::Vector3d ThreeJoint::last_link_rate_rad_s(const LegPose& pose,
                                                 const JointVector& velocity_rad_s) const noexcept {
  const double in_plane_rad_s = velocity_rad_s[1] - velocity_rad_s[2];
  return Eigen::Vector3d(velocity_rad_s[0], 0.0, 0.0) + abducted(pose.abduction, {0.0, in_plane_rad_s, 0.0});
}

/// That of the plane, what turning takes (toward the abduction axis), and Coriolis: sideways, where the foot
/// moves up or down in the plane.
Eigen::Vector3d ThreeJoint::even_motion_acceleration_m_s2(const LegPose& pose,
                                                          const JointVector& velocity_rad_s) const noexcept {
  const Eigen::Vector2d w = in_plane(velocity_rad_s);
  const double roll_rad_s = velocity_rad_s[0];
  const double up_m_s = plane_.jacobian(pose).row(2).dot(w);
  const double height_m = plane_.foot_in_hip_m(pose).z();
  Eigen::Vector3d in_plane_m_s2 = plane_.even_motion_acceleration_m_s2(pose, w);
  in_plane_m_s2.y() = -2.0 * roll_rad_s * up_m_s - roll_rad_s * roll_rad_s * offset_m_;
  in_plane_m_s2.z() -= roll_rad_s * roll_rad_s * height_m;
  return abducted(pose.abduction, in_plane_m_s2);
}

Eigen::Vector2d ThreeJoint::nearest_in_reach_m(double forward_m, double from_axis_m) const noexcept {
  const double offset = std::abs(offset_m_);
  const double folded = std::abs(thigh_.length_m - shank_.length_m);
  const double straight = thigh_.length_m + shank_.length_m;
  const double distance = std::hypot(forward_m, from_axis_m);
  const double reached = std::clamp(distance, nearest_m_, farthest_m_);
  if (distance > 0.0) {
    Eigen::Vector2d radial = Eigen::Vector2d(forward_m, from_axis_m) * (reached / distance);
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
  const InverseResult plane = plane_.inverse({foot.x(), 0.0, above ? depth : -depth},
                                             joint_vector(near_rad[1], near_rad[2]));
  InverseResult out;
  out.position_rad = joint_vector(above ? with_foot_above : with_foot_below, plane.position_rad[0],
                                  plane.position_rad[1]);
  out.reachable = (foot - wanted).norm() <= kInReach_m;
  return out;
}

JointVector ThreeJoint::gravity_torque_Nm(const LegPose& pose) const noexcept {
  const Eigen::Vector2d plane = plane_.weight_torque_Nm(pose, kGravity_m_s2 * pose.abduction.cosine);
  const double left_kg_m = pose.abduction.cosine * lateral_moment_kg_m_ -
                           pose.abduction.sine * plane_.mass_moment_kg_m(pose);
  return joint_vector(kGravity_m_s2 * left_kg_m, plane[0], plane[1]);
}

ThreeJoint::RollInertia ThreeJoint::roll_inertia(const LegPose& pose) const noexcept {
  const SineCosine& thigh = pose.thigh;
  const SineCosine& shank = pose.shank;
  const double thigh_kg_m2 = thigh_.inertia_kg_m2 + thigh_.mass_kg * thigh_.com_m * thigh_.com_m;
  const double shank_depth_m = thigh_.length_m * thigh.sine + shank_.com_m * shank.sine;
  const double by_thigh = 2.0 * thigh.cosine *
                          (thigh_kg_m2 * thigh.sine + shank_.mass_kg * shank_depth_m * thigh_.length_m);
  const double by_shank = 2.0 * shank.cosine *
                          (shank_.inertia_kg_m2 * shank.sine + shank_.mass_kg * shank_depth_m * shank_.com_m);
  const double value_kg_m2 = lateral_inertia_kg_m2_ + thigh_kg_m2 * thigh.sine * thigh.sine +
                             shank_.inertia_kg_m2 * shank.sine * shank.sine +
                             shank_.mass_kg * shank_depth_m * shank_depth_m;
  return {value_kg_m2, {by_thigh + by_shank, -by_shank}};
}

JointVector ThreeJoint::inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                            const JointVector& acceleration_rad_s2) const noexcept {
  const Eigen::Vector2d w = in_plane(velocity_rad_s);
  const Eigen::Vector2d a = in_plane(acceleration_rad_s2);
  const double roll_rad_s = velocity_rad_s[0];
  const double roll_rad_s2 = acceleration_rad_s2[0];
  const RollInertia inertia = roll_inertia(pose);
  const Eigen::Vector2d plane = plane_.motion_torque_Nm(pose, w, a) +
                                offset_m_ * roll_rad_s2 * plane_.weight_torque_Nm(pose, 1.0) -
                                0.5 * roll_rad_s * roll_rad_s * inertia.slope_kg_m2;
  const double roll_Nm = inertia.value_kg_m2 * roll_rad_s2 + roll_rad_s * inertia.slope_kg_m2.dot(w) +
                         offset_m_ * plane_.mass_moment_acceleration_N(pose, w, a);
  return joint_vector(roll_Nm, plane[0], plane[1]) + gravity_torque_Nm(pose);
}

double ThreeJoint::potential_energy_J(const JointVector& position_rad) const noexcept {
  const LegPose at = pose(position_rad);
  return kGravity_m_s2 *
         (at.abduction.sine * lateral_moment_kg_m_ + at.abduction.cosine * plane_.mass_moment_kg_m(at));
}

}  // namespace sprung
