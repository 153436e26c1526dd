#pragma once
/// How a foot comes back after a pull, and what the spring is that it was pulled against. Pure.
#include <array>
#include <vector>

#include "tools/lab/leg/foot_return_script.h"

namespace sprung {

/// In the leg's plane, from where the foot is to be: forward and up.
struct PlanePoint {
  double x_m = 0.0;
  double z_m = 0.0;
};

struct PullResult {
  FootPull pull;
  double moved_mm = 0.0;   ///< from where the foot was before, at the end of the hold, along the pull
  PlanePoint held_m;       ///< there
  PlanePoint back_m;       ///< at the end of the watch
  double error_mm = 0.0;   ///< distance of `back_m` from where the foot is to be
  double settled_s = 0.0;  ///< after the release: from then on within kSettled_mm of `back_m`
  double swing_mm = 0.0;   ///< foot, peak to peak of either axis, from kSettle_s after the release on
  double swing_Nm = 0.0;   ///< commanded torque, peak to peak of either joint, in the same time
  bool limit_cycle() const noexcept;

  static constexpr double kSettled_mm = 0.5;
  static constexpr double kSettle_s = 1.5;
  /// A foot that rests moves by less than 1 um; a motor's torque by what its encoder's noise makes of it, 0.1
  /// Nm.
  static constexpr double kSwing_mm = 0.2;
  static constexpr double kSwing_Nm = 1.0;
};

/// What is kept of a pull for a figure.
struct PullTrace {
  std::vector<double> time_s;  ///< from the release
  std::vector<PlanePoint> foot_m;
  std::vector<std::array<double, 2>> commanded_Nm;
};

/// One pull after the other, cycle by cycle.
class FootReturnScorer {
 public:
  explicit FootReturnScorer(const FootReturnScript& script) : script_(script) {}
  /// @param time_s since cycle 0. @param foot_m true, from where it is to be.
  void add(double time_s, const PlanePoint& foot_m, const std::array<double, 2>& commanded_Nm);
  std::vector<PullResult> results() const;
  const std::vector<PullTrace>& traces() const { return traces_; }

 private:
  FootReturnScript script_;
  std::vector<PullTrace> traces_;
};

PullResult pull_result(const FootPull& pull, const PullTrace& trace);

struct FootReturnSummary {
  double mean_mm = 0.0, max_mm = 0.0, min_mm = 0.0;  ///< of the errors
  double moved_least_mm = 0.0;
  double settled_worst_s = 0.0;
  int limit_cycles = 0;
  double stiffness_least_N_m = 0.0, stiffness_most_N_m = 0.0;  ///< of the directions; NaN with one force
};
FootReturnSummary summarize(const std::vector<PullResult>& pulls);

/// Slope of force over displacement along the pull, between the forces of one direction: friction that is the
/// same in every pull cancels. NaN where fewer than two forces were pulled with.
double measured_stiffness_N_m(const std::vector<PullResult>& pulls, double direction_rad);

}  // namespace sprung
