#pragma once
/// Keeps an actuator's position set-point where its drive's loop already gives all the torque that there is.
/// A leg that is torn away by a push would else be a following error (a drive lets go of the robot, and bus
/// by bus all others follow) long before the planner sees the fall and lets every leg down. Not for ever:
/// what is still held off after kHold_limit_s is blocked, and that the drive shall say. Pure.
#include "robots/robot_config.h"

namespace sprung {

class PositionWindow {
 public:
  /// Of torque limit / stiffness. Twice: also against a damping of half the limit the loop is saturated. A
  /// drive's own window is wider (EPOS2 profile: four times).
  static constexpr double kShare = 2.0;
  /// A robot that falls has fallen by then: 0.5 s from upright to 0.7 rad.
  static constexpr double kHold_limit_s = 0.6;

  /// An actuator whose stiffness is unknown has no window.
  explicit PositionWindow(const ActuatorConfig& actuator) noexcept;

  /// Once in a cycle of position control. @param measured_rad of the actuator. @return the set-point, or what
  /// the window leaves of it.
  double hold(double set_point_rad, double measured_rad, double cycle_s) noexcept;
  /// In the last cycle it acted.
  bool acts() const noexcept { return acts_; }

 private:
  double half_rad_;
  double held_s_ = 0.0;
  bool acts_ = false;
};

}  // namespace sprung
