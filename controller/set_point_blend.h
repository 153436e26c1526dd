#pragma once
/// How position set-points go over from what was to what is wanted, without a step of torque in a drive whose
/// position loop is  torque = K (set-point - position) + D (its rate - velocity). Pure; no heap after
/// construction.
///
/// Motion: the difference of old and new set-point and of their speeds fades along a cubic (Hermite), so that
/// the first set-point is the old one at its speed: measured position and velocity where the leg was not in
/// position control. Torque: what the motors gave before, tau, is asked of the position loop too, fading with
/// it: a displacement p with
///     D p' + K p = tau (t),   p (0) = 0.
/// A step of the set-point would not do: p = tau / K at once is tau / K / cycle for the rate, hundreds of Nm
/// in the drive's D. In the same way a torque that is known beforehand (feed-forward) is asked of a drive
/// that takes none: it comes as the old one goes.
#include <vector>

#include "controller/fade.h"
#include "model/leg_kinematics.h"
#include "model/transmission.h"
#include "robots/robot_config.h"

namespace sprung {

/// Position and velocity set-points of joints or actuators.
struct SetPoints {
  JointVector position_rad;
  JointVector velocity_rad_s;
};

class SetPointBlend {
 public:
  explicit SetPointBlend(const std::vector<ActuatorConfig>& actuators) noexcept;

  /// The joints' motion begins at `from` instead of at `to`.
  void start_motion(const SetPoints& from, const SetPoints& to) noexcept;
  /// The actuators' loops are to begin with these torques. An actuator whose stiffness is unknown begins with
  /// none.
  void start_torque(const JointVector& actuator_torque_Nm, double dt_s) noexcept;
  /// Of the actuators, from this cycle on, until the next call. Zero at first.
  void feed_forward(const JointVector& actuator_torque_Nm) noexcept;
  /// Once in a cycle, before the starts.
  void advance(double dt_s) noexcept;

  /// Of the joints: what is wanted, with what is left of the old motion.
  void add_motion(SetPoints& joints) const noexcept;
  /// Of the actuators: with the displacement that gives what is left of the old torque.
  void add_torque(SetPoints& actuators) const noexcept;

 private:
  void displace(double dt_s) noexcept;

  struct Loop {
    double stiffness_Nm_rad;
    double damping_Nm_s_rad;
    double torque_limit_Nm;
  };
  std::vector<Loop> loops_;
  Fade motion_, torque_;
  SetPoints offset_;       ///< of the joints, when the fade began
  JointVector torque_Nm_;  ///< of the actuators, when the fade began
  JointVector feedforward_Nm_;
  JointVector asked_Nm_;    ///< of the loops in this cycle, by the displacement
  SetPoints displacement_;  ///< p and p'
};

}  // namespace sprung
