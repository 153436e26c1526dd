#pragma once
/// How high a jump gets: from the amplitude of its curve (measured law), and what was learned from jumps that
/// came out higher or lower than asked. Pure.
#include <array>

#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung {

/// Below it the curve's amplitude hardly changes the height: the rest of the curve, from crouch to landing
/// length, lifts the leg off by itself.
inline constexpr double kLeastAmplitude = 0.4;

/// Height over the height at amplitude 1. Measured with preset `best`, hybrid, on single_leg's ground of 8.2
/// kN/m, 0.4 to 1.4: 0.566 - 0.738 s + 1.172 s^2, within 2 % there (docs/control.md, "Height and
/// adaptation").
double height_share(double amplitude) noexcept;
/// The other way round, at least kLeastAmplitude. @param share of the height at amplitude 1.
double amplitude_for(double share) noexcept;

/// One jump that came out otherwise changes the factor at most by this much, and all of them together within
/// these bounds: a wrong estimate must not make the next jump wild.
inline constexpr double kMostChange = 2.0;
inline constexpr double kLeastFactor = 0.4;
inline constexpr double kMostFactor = 2.5;

class HeightAdaptation {
 public:
  explicit HeightAdaptation(bool learns) : learns_(learns) { factors_.fill(1.0); }

  bool learns() const noexcept { return learns_; }
  /// What the law is to be asked for, over what the operator asked for.
  double factor(JumpMode mode) const noexcept { return factors_[index(mode)]; }
  /// After a jump; heights in m, both > 0. Ignored where they are not, and in a preset that does not learn.
  void learn(JumpMode mode, double asked_m, double estimated_m) noexcept;

 private:
  static std::size_t index(JumpMode mode) noexcept { return static_cast<std::size_t>(mode) % 4; }

  bool learns_;
  std::array<double, 4> factors_{};  ///< of each mode: a soft leg jumps lower
};

}  // namespace sprung
