#pragma once
/// How high the ground is expected under the next foot, from those that stand. Pure, no heap.
#include <array>

#include "planner/gait/gait_clock.h"

namespace sprung {

struct GroundFoot {
  double z_m = 0.0;  ///< measured, level axes of the trunk
  bool stands = false;
};

/// The trunk moves over the ground, and another foot that stands is other ground. Whatever is in the air
/// follows the former at once; the latter is learned slowly, since a drive's position loop passes on every
/// jerk of its set-point, and what jerks feigns contact.
class ExpectedGround {
 public:
  void begin(double z_m) noexcept;
  void follow(const std::array<GroundFoot, kMostLegs>& feet, double dt_s) noexcept;

  /// Level axes of the trunk: minus its height.
  double z_m() const noexcept { return z_m_; }
  /// By which the trunk came down in the last cycle, as the feet show that stood before and after it.
  double sunk_m() const noexcept { return sunk_m_; }

 private:
  double z_m_ = 0.0;
  double sunk_m_ = 0.0;
  std::array<GroundFoot, kMostLegs> before_{};
};

}  // namespace sprung
