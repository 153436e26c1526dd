#pragma once
/// What is left of an old set-point after a change of mode, along a cubic. Pure.
#include <algorithm>

namespace sprung {

inline constexpr double kFade_s = 0.020;  ///< shortest: docs/sources.md, facts B2, switch over 20-30 ms
/// Time in which a torque fades so that no cycle changes it by more than `step`; both are shares of the
/// actuator's limit. The cubic is at most 1.5 times as steep as a straight line.
inline double fade_time_s(double torque, double step, double cycle_s) noexcept {
  return std::max(kFade_s, 1.5 * torque * cycle_s / step);
}

class Fade {
 public:
  void start(double duration_s) noexcept {
    duration_s_ = duration_s;
    time_s_ = 0.0;
  }
  void advance(double dt_s) noexcept { time_s_ += dt_s; }
  /// From 1 to 0, slope 0 at both ends: 1 - 3 x^2 + 2 x^3.
  double share() const noexcept {
    const double x = phase();
    return 1.0 - x * x * (3.0 - 2.0 * x);
  }
  /// d share / dt.
  double rate_1_s() const noexcept {
    const double x = phase();
    return duration_s_ > 0.0 ? -6.0 * x * (1.0 - x) / duration_s_ : 0.0;
  }
  /// From 0 at slope 1 to 0 at slope 0: where an old speed leads to, per speed. T x (1 - x)^2.
  double run_s() const noexcept {
    const double x = phase();
    return duration_s_ * x * (1.0 - x) * (1.0 - x);
  }
  /// d run / dt, from 1 to 0.
  double run_rate() const noexcept {
    const double x = phase();
    return (1.0 - x) * (1.0 - 3.0 * x);
  }

 private:
  double phase() const noexcept {
    return duration_s_ > 0.0 ? std::clamp(time_s_ / duration_s_, 0.0, 1.0) : 1.0;
  }
  double duration_s_ = 0.0;  ///< 0: over
  double time_s_ = 0.0;
};

}  // namespace sprung
