#include "simulation/plant/transmission.h"

#include <Eigen/Dense>
#include <algorithm>

#include "robots/robot_loader.h"

namespace sprung::sim {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

Transmission::Transmission(const RobotConfig& robot) {
  const auto joints = static_cast<Eigen::Index>(robot.joints.size());
  const auto actuators = static_cast<Eigen::Index>(robot.actuators.size());
  RowMajor whole = RowMajor::Zero(joints, actuators);
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t row = 0; row < leg.joints.size(); ++row) {
      for (std::size_t column = 0; column < leg.actuators.size(); ++column) {
        whole(leg.joints[row], leg.actuators[column]) = leg.transmission[row * leg.actuators.size() + column];
      }
    }
  }
  const Eigen::FullPivLU<RowMajor> factors(whole);
  if (joints != actuators || !factors.isInvertible()) {
    throw ConfigError(robot.name + ": transmission cannot be inverted, so the plant cannot be driven");
  }
  const RowMajor inverse = factors.inverse();
  for (Eigen::Index a = 0; a < actuators; ++a) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      if (inverse(a, j) != 0.0)
        shares_.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(j), inverse(a, j)});
    }
  }
}

void Transmission::to_actuators(const std::vector<double>& joints,
                                std::vector<double>& actuators) const noexcept {
  std::fill(actuators.begin(), actuators.end(), 0.0);
  for (const Share& share : shares_) actuators[share.actuator] += share.of * joints[share.joint];
}

void Transmission::torques_to_joints(const std::vector<double>& actuator_Nm,
                                     std::vector<double>& joint_Nm) const noexcept {
  std::fill(joint_Nm.begin(), joint_Nm.end(), 0.0);
  for (const Share& share : shares_) joint_Nm[share.joint] += share.of * actuator_Nm[share.actuator];
}

}  // namespace sprung::sim
