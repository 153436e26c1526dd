#pragma once
/// A share that falls from 1 to 0 with continuous slope: what is left of an old set-point after a change of
/// mode. Pure.
#include <algorithm>

namespace sprung {

class Fade {
 public:
  void start(double duration_s) noexcept {
    duration_s_ = duration_s;
    time_s_ = 0.0;
  }
  void advance(double dt_s) noexcept { time_s_ += dt_s; }
  /// 1 - 3 x^2 + 2 x^3.
  double share() const noexcept {
    const double x = phase();
    return 1.0 - x * x * (3.0 - 2.0 * x);
  }
  /// d share / dt.
  double rate_1_s() const noexcept {
    const double x = phase();
    return duration_s_ > 0.0 ? -6.0 * x * (1.0 - x) / duration_s_ : 0.0;
  }

 private:
  double phase() const noexcept {
    return duration_s_ > 0.0 ? std::clamp(time_s_ / duration_s_, 0.0, 1.0) : 1.0;
  }
  double duration_s_ = 0.0;  ///< 0: over
  double time_s_ = 0.0;
};

}  // namespace sprung
