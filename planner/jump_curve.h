#pragma once
/// Length of the leg over time in a jump: extension, then flexion, then the landing length.
/// Pure.
#include <array>

#include "planner/bezier.h"
#include "planner/foot_move.h"
#include "robots/robot_config.h"

namespace sprung {

/// Where the foot is along x in a jump forward, as control points over this speed times the curve's duration
/// (first) and over the distance of landing (second): it rests, goes backward while the leg pushes, swings
/// ahead and rests again.
inline constexpr std::array<double, 7> kForwardPush{0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0};
inline constexpr std::array<double, 7> kForwardLanding{0.0, 0.0, 0.0, 0.0, -1.0, 1.0, 1.0};
/// Slope of kForwardPush's curve in the middle, where the leg leaves the ground.
inline constexpr double kForwardSlope = 0.9375;
/// Of the distance forward that share is the foot's own, ahead of the hip at touchdown.
inline constexpr double kForwardAhead = 0.1;

class JumpCurve {
 public:
  /// Control points of the first half count from the crouch, the others from the landing length (C2's own
  /// form); their excess is scaled. @throws std::invalid_argument naming the preset: no curve, or one that
  /// does not end at landing_length.
  explicit JumpCurve(const PresetConfig& preset);

  void scale(double factor) noexcept;  ///< of the next jump
  /// Of the next jump, too: foot that pushes the hip forward and lands ahead. Apart from the height, as in
  /// the papers: it is in the control points' x alone. @param flight_s expected; > 0.
  void forward(double distance_m, double flight_s) noexcept;
  double factor() const noexcept { return factor_; }
  double duration_s() const noexcept { return at_unit_.duration_s(); }
  double crouch_length_m() const noexcept { return crouch_length_m_; }
  double longest_m() const noexcept { return longest_m_; }  ///< of the whole curve, as scaled
  double end_length_m() const noexcept { return at_unit_.end(); }
  /// Foot under the hip, but for the way forward; after the curve it rests at the landing length.
  FootPoint at(double time_s) const noexcept;

 private:
  // Bezier curves are linear in their control points: length = base(t) + factor * excess(t).
  Bezier at_unit_;
  Bezier excess_;
  Bezier push_;
  Bezier ahead_;
  double push_m_ = 0.0;   ///< on `push_`
  double ahead_m_ = 0.0;  ///< on `ahead_`
  double crouch_length_m_;
  double factor_ = 1.0;
  double longest_m_ = 0.0;
};

}  // namespace sprung
