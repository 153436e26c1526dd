#pragma once
/// The reference of a drive's profile modes: it goes to a position, or takes up a speed, within a speed and
/// accelerations. Pure; counts of the motor's encoder, stepped once a tick.
#include "simulation/node/motor_control.h"

namespace sprung::sim {

struct ProfileLimits {
  double speed_counts_s = 0.0;
  double acceleration_counts_s2 = 0.0;
  double deceleration_counts_s2 = 0.0;
};

class ProfileMotion {
 public:
  /// At rest where the shaft is, or as fast as it turns.
  void enter(double counts, double velocity_counts_s = 0.0) noexcept;
  /// One tick on the way to a position, where it ends at rest.
  PositionLoop::Reference to_position(double target_counts, const ProfileLimits& limits,
                                      double dt_s) noexcept;
  /// One tick on the way to a speed; the position follows.
  PositionLoop::Reference to_velocity(double target_counts_s, const ProfileLimits& limits,
                                      double dt_s) noexcept;
  PositionLoop::Reference reference() const noexcept { return reference_; }

 private:
  void turn_faster_or_slower(double target_counts_s, const ProfileLimits& limits, double dt_s) noexcept;

  PositionLoop::Reference reference_;
};

}  // namespace sprung::sim
