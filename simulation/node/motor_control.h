#pragma once
/// The drive's own loops at its own rate: position loop with interpolated set-points, and the current loop as
/// a first-order lag. Pure; gear output side, in the motor's own forward direction.
#include <cstdint>

namespace sprung::sim {

/// torque = stiffness (reference - measured) + damping (reference velocity - measured velocity), the PD with
/// velocity reference of facts C2, J3. References are counts; between set-points they go in a straight line.
class PositionLoop {
 public:
  struct Reference {
    double position_counts = 0.0;
    double velocity_counts_s = 0.0;
  };
  /// Starts where the shaft is, so that entering the mode is bumpless, and goes to the set-point given
  /// before, if any.
  void enter(double measured_counts) noexcept;
  /// New set-point, to be reached one interpolation period from now.
  /// @param clock_s period of a clock of the drive's own, which SYNC keeps in step: it is reached when that
  /// says so, and one that comes a moment early or late changes no speed. 0: there is none.
  void set_target(double target_counts, double clock_s = 0.0) noexcept;
  /// One tick. @param period_s interpolation period, 0x60C2.
  /// @param extrapolates after it, until the next set-point, it goes on as fast as before; else it stays.
  Reference step(double dt_s, double period_s, bool extrapolates = false) noexcept;

 private:
  double reference_counts_ = 0.0;
  double start_counts_ = 0.0;
  double target_counts_ = 0.0;
  double elapsed_s_ = 0.0;  ///< since the last set-point
  double length_s_ = 0.0;   ///< of the way to it, as far as it is known
  double early_s_ = 0.0;    ///< it came so much before the clock; negative: after it
  bool has_target_ = false;
};

/// Current follows its set-point as a first-order lag, exact for a set-point that is constant over the tick.
class CurrentLoop {
 public:
  CurrentLoop(double bandwidth_Hz, double dt_s) noexcept;
  double step(double target_A) noexcept;
  void switch_off() noexcept { current_A_ = 0.0; }
  double current_A() const noexcept { return current_A_; }

 private:
  double share_ = 0.0;  ///< of the remaining difference that one tick closes
  double current_A_ = 0.0;
};

/// i2t: the winding's warmth follows (current / continuous current)^2 as a first-order lag; when it reaches
/// 1, only the continuous current is allowed until it is back below kRelease.
class ThermalLimit {
 public:
  static constexpr double kRelease = 0.95;  ///< [design choice]
  void reset() noexcept { *this = ThermalLimit(); }
  /// One tick. @return whether only the continuous current is allowed now.
  bool step(double current_A, double continuous_A, double time_constant_s, double dt_s) noexcept;

 private:
  double warmth_ = 0.0;
  bool limits_ = false;
};

/// Largest torque in the direction of motion: `limit` up to 90 % of the speed cap, from there straight down
/// to 0 at the cap and on to braking above it. Against the motion the full limit stays. @return torque within
/// its bounds.
double limit_torque(double torque, double limit, double velocity_rad_s, double speed_cap_rad_s) noexcept;

}  // namespace sprung::sim
