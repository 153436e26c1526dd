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
  /// Of T^-1, where it is not zero: each leg has its own block.
  struct Share {
    std::size_t actuator = 0;
    std::size_t joint = 0;
    double of = 0.0;
  };
  std::vector<Share> shares_;  ///< by actuator, then joint
};

}  // namespace sprung::sim
