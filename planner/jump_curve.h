#pragma once
/// Length of the leg over time in a jump of given height: extension, then flexion, then the landing length.
/// Pure.
#include "planner/bezier.h"
#include "planner/foot_move.h"
#include "robots/robot_config.h"

namespace sprung {

inline constexpr double kLowestJump_m = 0.02;
/// Times the height of the robot file's own curve: higher would leave the range in which the square root below was checked.
inline constexpr double kHighestJump = 1.1;

/// Take-off speed goes with the square root of the height, and so does the curve's amplitude: sqrt(height / height of the robot
/// file's own curve).
/// @return 1 for height 0 (the file's own curve), NaN outside 0.02 m to 1.1 times that height.
double jump_scale(const JumpCurveConfig& curve, double height_m) noexcept;

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
  double longest_m() const noexcept { return longest_m_; }  ///< of the whole curve, as scaled
  double end_length_m() const noexcept { return at_unit_.end(); }
  /// Foot straight under the hip; after the curve it rests at the landing length.
  FootPoint at(double time_s) const noexcept;

 private:
  // Bezier curves are linear in their control points: length = base(t) + factor * excess(t).
  Bezier at_unit_;
  Bezier excess_;
  double crouch_length_m_;
  double factor_ = 1.0;
  double longest_m_ = 0.0;
};

}  // namespace sprung
