#pragma once
/// Hip and knee in the x-z plane. theta1: thigh angle from +x, positive downward (pi/2 is straight down);
/// theta2: knee flexion, so that the absolute shank angle is theta1 - theta2. With theta2 > 0 and the foot
/// under the hip the knee is behind. Equations: S0 (10) to (12) with errata E1, E3,
/// E4, and M, V, G of facts A6 (docs/sources.md).
#include "model/leg_kinematics.h"

namespace sprung {

class TwoLink final : public LegKinematics {
 public:
  /// @throws std::invalid_argument unless there are two joints and two links of positive length.
  explicit TwoLink(const LegConfig& leg);

  using LegKinematics::foot_in_hip_m;
  using LegKinematics::gravity_torque_Nm;
  using LegKinematics::inverse_dynamics_Nm;
  using LegKinematics::jacobian;

  int joint_count() const noexcept override { return 2; }
  LegPose pose(const JointVector& position_rad) const noexcept override;
  Eigen::Vector3d foot_in_hip_m(const LegPose& pose) const noexcept override;
  LegJacobian jacobian(const LegPose& pose) const noexcept override;
  Eigen::Vector3d last_link_rate_rad_s(const LegPose& pose,
                                       const JointVector& velocity_rad_s) const noexcept override;
  Eigen::Vector3d even_motion_acceleration_m_s2(const LegPose& pose,
                                                const JointVector& velocity_rad_s) const noexcept override;
  /// Unreachable also when the foot is out of the leg's plane by more than 1 um. A foot within 1 nm of the
  /// hip leaves the hip's angle where it is; one that is not finite leaves both.
  InverseResult inverse(const Eigen::Vector3d& foot_in_hip_m,
                        const JointVector& near_rad) const noexcept override;
  JointVector gravity_torque_Nm(const LegPose& pose) const noexcept override;
  JointVector inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                  const JointVector& acceleration_rad_s2) const noexcept override;
  /// Gradient of mass_moment_kg_m times gravity: what holds the links where gravity in their plane is this
  /// much.
  Eigen::Vector2d weight_torque_Nm(const LegPose& pose, double gravity_m_s2) const noexcept;
  /// M qdd + V, without gravity.
  Eigen::Vector2d motion_torque_Nm(const LegPose& pose, const Eigen::Vector2d& velocity_rad_s,
                                   const Eigen::Vector2d& acceleration_rad_s2) const noexcept;
  /// Sum of mass times height over the hip, of both links.
  double mass_moment_kg_m(const LegPose& pose) const noexcept;
  /// Second derivative of mass_moment_kg_m by time.
  double mass_moment_acceleration_N(const LegPose& pose, const Eigen::Vector2d& velocity_rad_s,
                                    const Eigen::Vector2d& acceleration_rad_s2) const noexcept;
  /// Of both links, zero at the height of the hip.
  double potential_energy_J(const JointVector& position_rad) const noexcept;

 private:
  LinkConfig thigh_;
  LinkConfig shank_;
  double thigh_moment_kg_m_;  ///< of all that hangs on the thigh, the shank as if at the knee, about the hip
  double shank_moment_kg_m_;  ///< about the knee
};

}  // namespace sprung
