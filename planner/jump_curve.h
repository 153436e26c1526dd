#pragma once
/// Length of the leg over time in a jump of given height: extension, then flexion, then the landing length.
/// Pure.
#include "planner/bezier.h"
#include "planner/foot_move.h"
#include "robots/robot_config.h"

namespace sprung {

/// The robot file's own curve jumps this high (facts A2 and C2: 184 to 188 mm), rounded.
inline constexpr double kNominalJumpHeight_m = 0.18;
inline constexpr double kLowestJump_m = 0.02;
inline constexpr double kHighestJump_m = 0.22;

/// Take-off speed goes with the square root of the height, and so does the curve's amplitude: sqrt(height /
/// nominal).
/// @return 1 for height 0 (the file's own curve), NaN outside [0.02, 0.22] m.
double jump_scale(double height_m) noexcept;

class JumpCurve {
 public:
  /// Control points of the first half count from the crouch, the others from the landing length (C2's own
  /// form); their excess is scaled. @throws std::invalid_argument naming the preset: no curve, or one that
  /// does not end at landing_length.
  explicit JumpCurve(const PresetConfig& preset);

  void scale(double factor) noexcept;  ///< of the next jump
  double factor() const noexcept { return factor_; }
  double duration_s() const noexcept { return at_unit_.duration_s(); }
  double crouch_length_m() const noexcept { return crouch_length_m_; }
  /// Foot straight under the hip; after the curve it rests at the landing length.
  FootPoint at(double time_s) const noexcept;

 private:
  // Bezier curves are linear in their control points: length = base(t) + factor * excess(t).
  Bezier at_unit_;
  Bezier excess_;
  double crouch_length_m_;
  double factor_ = 1.0;
};

}  // namespace sprung
