#pragma once
/// Warmth of a motor's winding by the current that the drive measures (i2t): (current / rated current)^2 as a
/// first-order lag with the winding's time constant, 1 = what the rated current alone ends at. It starts
/// cold: what was before the bridge began nobody knows. Pure; once a sample.
#include <cstdint>

namespace sprung {

class WindingWatch {
 public:
  /// @param time_constant_s of the winding; 0: not known, nothing is watched.
  WindingWatch(double rated_current_A, double time_constant_s) noexcept
      : rated_A_(rated_current_A), time_constant_s_(time_constant_s) {}

  /// @param measured_current_A not finite: as the one before.
  void add(double measured_current_A, std::int64_t time_us) noexcept;
  double warmth() const noexcept { return warmth_; }
  /// From 1 on, until it is below 0.95: no more than the rated current.
  bool warm() const noexcept { return warm_; }
  /// Above 1.2: what should have been limited is not.
  bool hot() const noexcept { return warmth_ > kHot; }
  /// Until it is warm, if the current stays what it was on (quadratic) average of late, some ten seconds; 0:
  /// it is. NaN: never at that current, or nothing is watched.
  double warm_in_s() const noexcept;

 private:
  static constexpr double kHot = 1.2;  // [design choice]

  double rated_A_;
  double time_constant_s_;
  double warmth_ = 0.0;
  double load_ = 0.0, seen_s_ = 0.0;  ///< (current / rated current)^2, mean of late; over how long
  double last_A_ = 0.0;
  std::int64_t last_us_ = -1;
  bool warm_ = false;
};

}  // namespace sprung
