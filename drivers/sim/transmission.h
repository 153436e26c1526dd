#pragma once
/// Between the actuators that drives know and the joints that the plant has: joint = T actuator for angles
/// and speeds, and by power balance joint torque = T^-T actuator torque. T is robot.yaml's.
#include <vector>

#include "robots/robot_config.h"

namespace sprung::sim {

class Transmission {
 public:
  /// @throws ConfigError on a leg whose matrix cannot be inverted, or an actuator or joint without a leg.
  explicit Transmission(const RobotConfig& robot);
  /// Angles or speeds; sizes as in the robot.
  void to_actuators(const std::vector<double>& joints, std::vector<double>& actuators) const noexcept;
  void torques_to_joints(const std::vector<double>& actuator_Nm,
                         std::vector<double>& joint_Nm) const noexcept;

 private:
  std::size_t joints_ = 0;
  std::size_t actuators_ = 0;
  std::vector<double> inverse_;  ///< T^-1, row-major actuators x joints
};

}  // namespace sprung::sim
