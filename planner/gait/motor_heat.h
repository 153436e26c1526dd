#pragma once
/// How fast a robot may walk on whose motors get warm. At their rated warmth they get no more than their
/// rated current, which three or two legs may not stand on: before that it walks slower, and then stands on
/// all its feet. Pure.
#include "signals/joint_state.h"

namespace sprung {

class MotorHeat {
 public:
  /// A walk begins: only with motors that are well below.
  void begin(const JointState& in) noexcept;
  void step(const JointState& in) noexcept;

  /// Of the wanted speed.
  double speed_share() const noexcept;
  /// Walking on would end in a limit.
  bool too_warm() const noexcept { return warmth_ >= most_; }

  // [design choice] Shares of the rated warmth (JOINT_STATE's winding_share). With twice the rated current a
  // winding of 50 s takes 1.7 s from the second to the rated one: a walk stops within 0.8 s.
  static constexpr double kSlowFrom = 0.80, kStands = 0.92;

 private:
  double warmth_ = 0.0;
  double most_ = kStands;
};

}  // namespace sprung
