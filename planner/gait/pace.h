#pragma once
/// How a walk keeps its speed. While its clock waits, for a late foot or for the body's weight, the body
/// waits too, since feet that stand still must not be left behind; and what springs lag by is forgotten with
/// each foot that is set anew. What was lost so is caught up with. Pure.
#include <array>

#include "robots/gait_config.h"

namespace sprung {

class Pace {
 public:
  using Speed = std::array<double, 3>;  ///< forward, left, m/s; turning, rad/s

  void reset() noexcept { *this = Pace(); }
  /// One cycle. @param gait how fast it may go: nothing is caught up with beyond, nor by more than a share
  /// kMost of what is wanted.
  void advance(bool waits, const Speed& wanted, const GaitConfig& gait, double dt_s) noexcept;
  /// The body is that much behind where it was to be, forward and left; no number of a foot that nobody knows
  /// counts.
  void lose(double forward_m, double left_m) noexcept;

  double now() const noexcept { return now_; }  ///< 0: the body stands still with the clock, 1: it goes
  const Speed& speed() const noexcept { return speed_; }  ///< while the clock goes

  static constexpr double kMost = 0.2;

 private:
  void slow_down(double most_share, const GaitConfig& gait) noexcept;

  double now_ = 1.0;
  std::array<double, 3> lost_{};  ///< m, m, rad
  Speed speed_{};
};

}  // namespace sprung
