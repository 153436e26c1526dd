#pragma once
/// Desired foot motion between the planner's cycle and now. Pure.
#include <Eigen/Core>

#include "model/leg_kinematics.h"
#include "signals/leg_command.h"

namespace sprung {

struct FootMotion {
  Eigen::Vector3d position_m;
  Eigen::Vector3d velocity_m_s;
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
};

/// Constant acceleration over `age_s`.
inline FootMotion extrapolate(const DesiredLeg& desired, double age_s) noexcept {
  const Eigen::Vector3d velocity = to_eigen(desired.desired_foot_velocity_m_s);
  const Eigen::Vector3d acceleration = to_eigen(desired.desired_foot_acceleration_m_s2);
  return {to_eigen(desired.desired_foot_in_hip_m) + age_s * (velocity + 0.5 * age_s * acceleration),
          velocity + age_s * acceleration, acceleration};
}

}  // namespace sprung
