#pragma once
/// One joint from rest to rest with a trapezoidal speed: constant acceleration, constant speed, the same
/// acceleration backward. Not smoother, since a constant acceleration is what shows a joint's inertia. Pure.
namespace sprung {

struct JointPoint {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
};

class JointMove {
 public:
  JointMove() = default;
  /// Rests there.
  explicit JointMove(double at_rad) noexcept : from_rad_(at_rad), to_rad_(at_rad) {}
  /// @param speed_rad_s, acceleration_rad_s2 both > 0; a short way never reaches the speed.
  JointMove(double from_rad, double to_rad, double speed_rad_s, double acceleration_rad_s2) noexcept;

  /// Rests at the nearer end outside [0, duration].
  JointPoint at(double time_s) const noexcept;
  double duration_s() const noexcept { return rising_s_ + steady_s_ + falling_s_; }
  double end_rad() const noexcept { return to_rad_; }
  /// Comes to rest from `time_s` on, with the same acceleration; its own time begins there.
  JointMove braked(double time_s) const noexcept;

 private:
  double from_rad_ = 0.0;
  double to_rad_ = 0.0;
  double acceleration_rad_s2_ = 0.0;  ///< while rising, with the sign of the move
  double peak_rad_s_ = 0.0;           ///< the same sign
  double rising_s_ = 0.0;
  double steady_s_ = 0.0;
  double falling_s_ = 0.0;
};

}  // namespace sprung
