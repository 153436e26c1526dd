#include "drivers/sim/transmission.h"

#include <Eigen/Dense>

#include "robots/robot_loader.h"

namespace sprung::sim {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

Transmission::Transmission(const RobotConfig& robot)
    : joints_(robot.joints.size()), actuators_(robot.actuators.size()) {
  RowMajor whole = RowMajor::Zero(static_cast<int>(joints_), static_cast<int>(actuators_));
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t row = 0; row < leg.joints.size(); ++row) {
      for (std::size_t column = 0; column < leg.actuators.size(); ++column) {
        whole(leg.joints[row], leg.actuators[column]) = leg.transmission[row * leg.actuators.size() + column];
      }
    }
  }
  const Eigen::FullPivLU<RowMajor> factors(whole);
  if (joints_ != actuators_ || !factors.isInvertible()) {
    throw ConfigError(robot.name + ": transmission cannot be inverted, so the plant cannot be driven");
  }
  const RowMajor inverse = factors.inverse();
  inverse_.assign(inverse.data(), inverse.data() + inverse.size());
}

void Transmission::to_actuators(const std::vector<double>& joints,
                                std::vector<double>& actuators) const noexcept {
  for (std::size_t a = 0; a < actuators_; ++a) {
    actuators[a] = 0.0;
    for (std::size_t j = 0; j < joints_; ++j) actuators[a] += inverse_[a * joints_ + j] * joints[j];
  }
}

void Transmission::torques_to_joints(const std::vector<double>& actuator_Nm,
                                     std::vector<double>& joint_Nm) const noexcept {
  for (std::size_t j = 0; j < joints_; ++j) {
    joint_Nm[j] = 0.0;
    for (std::size_t a = 0; a < actuators_; ++a) joint_Nm[j] += inverse_[a * joints_ + j] * actuator_Nm[a];
  }
}

}  // namespace sprung::sim
