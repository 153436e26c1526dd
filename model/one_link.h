#pragma once
/// An arm that swings in the x-z plane about a horizontal axis, as on S0's bench (section II-A); its "foot"
/// is the arm's end. theta: 0 is straight down, positive toward +x, so that the weight pulls back with m g c
/// sin(theta).
#include "model/leg_kinematics.h"

namespace sprung {

class OneLink final : public LegKinematics {
 public:
  /// @throws std::invalid_argument unless there are one joint and one link of positive length.
  explicit OneLink(const LegConfig& leg);

  using LegKinematics::foot_in_hip_m;
  using LegKinematics::gravity_torque_Nm;
  using LegKinematics::inverse_dynamics_Nm;
  using LegKinematics::jacobian;

  int joint_count() const noexcept override { return 1; }
  LegPose pose(const JointVector& position_rad) const noexcept override;
  Eigen::Vector3d foot_in_hip_m(const LegPose& pose) const noexcept override;
  LegJacobian jacobian(const LegPose& pose) const noexcept override;
  Eigen::Vector3d last_link_rate_rad_s(const LegPose& pose,
                                       const JointVector& velocity_rad_s) const noexcept override;
  Eigen::Vector3d even_motion_acceleration_m_s2(const LegPose& pose,
                                                const JointVector& velocity_rad_s) const noexcept override;
  /// The angle toward the foot; unreachable when the foot is more than 1 mm off the arm's circle: a foot that
  /// is extrapolated along the tangent stays nearer.
  InverseResult inverse(const Eigen::Vector3d& foot_in_hip_m,
                        const JointVector& near_rad) const noexcept override;
  JointVector gravity_torque_Nm(const LegPose& pose) const noexcept override;
  JointVector inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                  const JointVector& acceleration_rad_s2) const noexcept override;

 private:
  LinkConfig arm_;
};

}  // namespace sprung
