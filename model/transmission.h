#pragma once
/// Between the actuators and the joints of one leg. joint position = T * actuator position (also velocities);
/// power is the same on both sides, so actuator torque = T^T * joint torque. Pure; no heap after
/// construction.
#include <Eigen/Core>

#include "model/leg_kinematics.h"

namespace sprung {

class Transmission {
 public:
  /// @throws std::invalid_argument naming the leg when the matrix is not square, does not fit or is singular.
  explicit Transmission(const LegConfig& leg);

  int size() const noexcept { return static_cast<int>(to_joint_.rows()); }
  /// Each actuator is its joint: nothing has to be multiplied.
  bool direct() const noexcept { return direct_; }
  JointVector joint_from_actuator(const JointVector& actuator_motion) const noexcept;
  JointVector actuator_from_joint(const JointVector& joint_motion) const noexcept;
  JointVector joint_torque(const JointVector& actuator_torque_Nm) const noexcept;
  JointVector actuator_torque(const JointVector& joint_torque_Nm) const noexcept;
  /// Does this actuator's motion enter this joint's position, or its torque this joint's torque?
  bool couples(int joint, int actuator) const noexcept {
    return to_joint_(joint, actuator) != 0.0 || to_actuator_(actuator, joint) != 0.0;
  }
  /// Of one joint: of an actuator that is not coupled to it nothing is read, be it NaN.
  double joint_from_coupled(int joint, const JointVector& actuator_motion) const noexcept;
  /// Bounds add up, whatever the signs of T: |T| * actuator bound.
  JointVector joint_motion_bound(const JointVector& actuator_bound) const noexcept;
  /// Bounds add up: |T^-T| * actuator bound.
  JointVector joint_torque_bound(const JointVector& actuator_bound_Nm) const noexcept;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxLegJoints,
                               kMaxLegJoints>;
  Matrix to_joint_;
  Matrix to_actuator_;
  bool direct_ = false;
};

}  // namespace sprung
