#pragma once
/// An arm that swings in the x-z plane about a horizontal axis, as on S0's bench (section II-A); its "foot" is the
/// arm's end. theta: 0 is straight down, positive toward +x, so that the weight pulls back with m g c sin(theta).
#include "controller/leg_kinematics.h"

namespace sprung {

class OneLink final : public LegKinematics {
 public:
  /// @throws std::invalid_argument unless there are one joint and one link of positive length.
  explicit OneLink(const LegConfig& leg);

  int joint_count() const noexcept override { return 1; }
  Eigen::Vector3d foot_in_hip_m(const JointVector& position_rad) const noexcept override;
  LegJacobian jacobian(const JointVector& position_rad) const noexcept override;
  /// The angle toward the foot; unreachable when the foot is more than 1 mm off the arm's circle: a foot that is
  /// extrapolated along the tangent stays nearer.
  InverseResult inverse(const Eigen::Vector3d& foot_in_hip_m,
                        const JointVector& near_rad) const noexcept override;
  JointVector gravity_torque_Nm(const JointVector& position_rad) const noexcept override;
  JointVector inverse_dynamics_Nm(const JointVector& position_rad, const JointVector& velocity_rad_s,
                                  const JointVector& acceleration_rad_s2) const noexcept override;

 private:
  LinkConfig arm_;
};

}  // namespace sprung
