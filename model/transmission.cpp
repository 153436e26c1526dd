#include "model/transmission.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace sprung {

Transmission::Transmission(const LegConfig& leg) {
  const std::size_t n = leg.actuators.size();
  const std::string who = "leg '" + leg.name + "': transmission ";
  if (n == 0 || n > kMaxLegJoints || leg.joints.size() != n || leg.transmission.size() != n * n) {
    throw std::invalid_argument(who + "must be joints x actuators, square, at most 6 x 6");
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  to_joint_ = Eigen::Map<const RowMajor>(leg.transmission.data(), static_cast<Eigen::Index>(n),
                                         static_cast<Eigen::Index>(n));
  const Eigen::FullPivLU<Matrix> lu(to_joint_);
  if (!lu.isInvertible()) throw std::invalid_argument(who + "is singular");
  to_actuator_ = lu.inverse();
  direct_ = to_joint_ == Matrix::Identity(to_joint_.rows(), to_joint_.cols());
}

JointVector Transmission::joint_from_actuator(const JointVector& actuator_motion) const noexcept {
  return to_joint_ * actuator_motion;
}

JointVector Transmission::actuator_from_joint(const JointVector& joint_motion) const noexcept {
  return to_actuator_ * joint_motion;
}

JointVector Transmission::joint_torque(const JointVector& actuator_torque_Nm) const noexcept {
  return to_actuator_.transpose() * actuator_torque_Nm;
}

JointVector Transmission::actuator_torque(const JointVector& joint_torque_Nm) const noexcept {
  return to_joint_.transpose() * joint_torque_Nm;
}

double Transmission::joint_from_coupled(int joint, const JointVector& actuator_motion) const noexcept {
  if (direct_) return actuator_motion[joint];
  double motion = 0.0;
  for (int i = 0; i < size(); ++i) {
    if (couples(joint, i)) motion += to_joint_(joint, i) * actuator_motion[i];
  }
  return motion;
}

JointVector Transmission::joint_motion_bound(const JointVector& actuator_bound) const noexcept {
  return to_joint_.cwiseAbs() * actuator_bound;
}

JointVector Transmission::joint_torque_bound(const JointVector& actuator_bound_Nm) const noexcept {
  return to_actuator_.transpose().cwiseAbs() * actuator_bound_Nm;
}

}  // namespace sprung
