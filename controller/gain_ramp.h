#pragma once
/// Gains of the virtual spring that change while it acts go over to their new value instead of stepping.
/// Pure.
///
/// Each gain moves at a constant speed that takes the larger of its old and its new value through in the
/// ramp's time: a step from 0 or to 0 takes all of it, a schedule that changes slowly is followed without
/// lag.
#include <array>

#include "signals/leg_command.h"

namespace sprung {

class GainRamp {
 public:
  /// @param ramp_s >= 0; 0: gains act at once.
  explicit GainRamp(double ramp_s) noexcept : ramp_s_(ramp_s) {}

  /// From now on as in `desired`, at once: the mode begins, and its own fade takes up the change.
  void start(const DesiredLeg& desired) noexcept;
  /// Replaces stiffness, damping, shares of friction, inertia and velocity in `desired` by those that act
  /// now.
  void advance(double dt_s, DesiredLeg& desired) noexcept;

 private:
  struct Gain {
    double acting = 0.0;
    double wanted = 0.0;
    double rate_1_s = 0.0;
  };
  static constexpr int kGains = 9;
  static std::array<double*, kGains> gains_of(DesiredLeg& desired) noexcept;

  double ramp_s_;
  std::array<Gain, kGains> gains_{};
};

}  // namespace sprung
