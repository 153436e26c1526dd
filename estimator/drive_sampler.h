#pragma once
/// What the drives of one leg measured, in joint space. Pure: no heap after construction.
#include <vector>

#include "estimator/joint_estimator.h"
#include "model/transmission.h"
#include "signals/drive_state.h"

namespace sprung {

class DriveSampler {
 public:
  /// @throws std::invalid_argument from Transmission, std::out_of_range on an index that the robot does not
  /// have.
  DriveSampler(const RobotConfig& robot, const LegConfig& leg);

  /// @param actuators all of the robot's. @param samples one for each joint of the leg.
  /// A joint is fresh when every drive that moves it is; other drives do not matter to it.
  void sample(const std::vector<ActuatorState>& actuators, std::vector<JointSample>& samples) const noexcept;

  /// One count of the motor encoders at this joint.
  double encoder_step_rad(int joint) const noexcept;

 private:
  double joint_link(int joint, const JointVector& link_rad) const noexcept;
  JointSample joint_sample(int joint, const std::vector<ActuatorState>& actuators) const noexcept;
  const ActuatorState& state(const std::vector<ActuatorState>& actuators, int i) const noexcept;

  std::vector<int> indices_;               ///< of this leg's actuators in the robot
  std::vector<ActuatorConfig> actuators_;  ///< the same, in leg order
  Transmission transmission_;
  JointVector quantisation_Nm_;  ///< joint side
};

}  // namespace sprung
