#pragma once
/// Abduction (HAA), hip (HFE) and knee (KFE): a two_link leg in a plane that turns about the forward axis.
///
/// Frame: x forward along the abduction axis, y left, z up, as the trunk; origin on the abduction axis,
/// beside the hip. Seen from behind, a left leg that stands straight (the right one is its mirror image):
///
///            z up
///   y left <--|
///      H-----O     O: abduction axis, forward, away from you; H: hip axis, sideways through O
///      |           O-H: the offset, to the left for side left, to the right for side right
///      K           H-K thigh, K-F shank, both in the plane that stands on the hip axis at H
///      |           abduction > 0 of either leg: all of it turns about O, the foot toward the left
///      F foot      hip, knee: as two_link in that plane; hip 90 degrees and knee 0 is straight down
///
/// Zero: abduction 0 is the plane upright; hip 0 thigh forward, positive downward; knee 0 straight, positive
/// flexion (foot under the hip: knee behind). As robots/pegasus: axes +x, +y, -y of its model.xml. A right
/// leg is the mirror image of a left one in y = 0 when its abduction has the other sign; hip and knee have
/// the same.
///
/// Links: hip (from the abduction axis sideways: length is the offset, com along it, inertia about the
/// forward axis), thigh, shank (in the plane at the offset; as thin rods, with no inertia about their own
/// axis). Equations: docs/control.md, "Leg kinematics".
#include "model/leg_kinematics.h"
#include "model/two_link.h"

namespace sprung {

class ThreeJoint final : public LegKinematics {
 public:
  /// @throws std::invalid_argument unless there are three joints and three links, thigh and shank of positive
  /// length.
  explicit ThreeJoint(const LegConfig& leg);

  using LegKinematics::foot_in_hip_m;
  using LegKinematics::gravity_torque_Nm;
  using LegKinematics::inverse_dynamics_Nm;
  using LegKinematics::jacobian;

  int joint_count() const noexcept override { return 3; }
  LegPose pose(const JointVector& position_rad) const noexcept override;
  Eigen::Vector3d foot_in_hip_m(const LegPose& pose) const noexcept override;
  LegJacobian jacobian(const LegPose& pose) const noexcept override;
  Eigen::Vector3d last_link_rate_rad_s(const LegPose& pose,
                                       const JointVector& velocity_rad_s) const noexcept override;
  Eigen::Vector3d even_motion_acceleration_m_s2(const LegPose& pose,
                                                const JointVector& velocity_rad_s) const noexcept override;
  /// Of the two abductions that reach a foot (leg's plane with the foot below or above O) the one nearer to
  /// near_rad, and then the knee bent as there. Unreachable: more than 1 nm out of reach, be it too far, too
  /// near, or nearer to the abduction axis than the offset; the pose is that of the nearest foot that is
  /// reachable. A foot that is not finite leaves the joints where they are.
  InverseResult inverse(const Eigen::Vector3d& foot_in_hip_m,
                        const JointVector& near_rad) const noexcept override;
  JointVector gravity_torque_Nm(const LegPose& pose) const noexcept override;
  JointVector inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                  const JointVector& acceleration_rad_s2) const noexcept override;
  /// Of all links, zero at the height of the abduction axis.
  double potential_energy_J(const JointVector& position_rad) const noexcept;

 private:
  struct RollInertia;  // about the abduction axis

  RollInertia roll_inertia(const LegPose& pose) const noexcept;
  /// To (distance along the abduction axis, distance from it).
  Eigen::Vector2d nearest_in_reach_m(double forward_m, double from_axis_m) const noexcept;

  LinkConfig thigh_;
  LinkConfig shank_;
  TwoLink plane_;
  double nearest_m_, farthest_m_;  // of all feet in reach, from O
  double offset_m_;                // of the leg's plane, positive to the left
  double lateral_moment_kg_m_;     // sum of mass times distance to the left, of all links
  double lateral_inertia_kg_m2_;   // about the abduction axis, of what does not depend on hip and knee
};

}  // namespace sprung
