#pragma once
/// The position loop of a drive that has none of known stiffness, closed here and sent as torque:
///
///   torque_Nm = stiffness (commanded_rad - predicted_rad) + damping (reference_rad_s - predicted_rad_s)
///
/// about the gear's output. As in a drive the reference moves in a straight line from set-point to set-point:
/// its velocity is the slope, 0 at the first, and commanded_rad the middle of the way that it makes in its
/// cycle. That cycle begins one after the sample: predicted_rad is where the measured velocity has taken the
/// joint in its middle, predicted_rad_s what the last cycle's acceleration makes of the velocity until it
/// begins (until its middle is too far for samples with noise). Torque stays within its limit, and makes
/// nothing faster than the speed limit. Pure.
#include "robots/robot_config.h"
#include "signals/vec3.h"

namespace sprung {

class HostPositionLoop {
 public:
  HostPositionLoop(const ActuatorConfig& actuator, double cycle_s) noexcept;

  /// Once a cycle while position is controlled, after the SetpointGate.
  double torque_Nm(double commanded_position_rad, double measured_position_rad,
                   double measured_velocity_rad_s) noexcept;
  /// Something else acts: the next set-point is the first one.
  void forget() noexcept;
  /// Position was controlled in the last cycle.
  bool closed() const noexcept;

 private:
  double predicted_velocity_rad_s(double measured_velocity_rad_s) noexcept;

  double stiffness_Nm_rad_, damping_Nm_s_rad_, torque_limit_Nm_, speed_limit_rad_s_, cycle_s_;
  double set_position_rad_ = kNaN;
  double last_velocity_rad_s_ = kNaN;  ///< measured, of the cycle before
};

}  // namespace sprung
