#pragma once
/// A leg in a pose, and the way from its foot's motion to that of its joints: made once by who asks more than
/// one question about it. Pure.
#include "model/leg_kinematics.h"

namespace sprung {

struct PosedLeg {
  LegPose pose;
  DampedInverse to_joints;
};

inline PosedLeg posed(const LegKinematics& kinematics, const JointVector& position_rad) noexcept {
  const LegPose pose = kinematics.pose(position_rad);
  return {pose, damped_inverse(kinematics.jacobian(pose))};
}

/// J^-1 v of a foot's velocity, hip axes, by the damped inverse: bounded in singular poses.
inline JointVector joint_velocity_rad_s(const PosedLeg& at, const Eigen::Vector3d& foot_m_s) noexcept {
  return at.to_joints.matrix.transpose() * foot_m_s;
}

/// J^-1 (a - J' q'), the same way: the joints' acceleration that a foot's acceleration asks for.
inline JointVector joint_acceleration_rad_s2(const LegKinematics& kinematics, const PosedLeg& at,
                                             const Eigen::Vector3d& foot_m_s2,
                                             const JointVector& velocity_rad_s) noexcept {
  return at.to_joints.matrix.transpose() *
         (foot_m_s2 - kinematics.even_motion_acceleration_m_s2(at.pose, velocity_rad_s));
}

}  // namespace sprung
