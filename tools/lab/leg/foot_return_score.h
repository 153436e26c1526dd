#pragma once
/// `sprung experiment foot_return` of a leg: what is done to it, how its foot comes back after a pull, and
/// what the spring is that it was pulled against. Pure.
///
/// The leg hangs, its foot on a virtual spring, and a hand pulls the foot away and lets go (S0 section V-A,
/// Figs. 8 and 9). Each pull, in its period of kPeriod_s, by the operator's commands alone: after the first,
/// `stop` lets the position loops bring the foot back to the stand pose; `comply`; the force grows in a
/// straight line, is held, and is gone at once; then the foot is watched. S0 does not say how its hand let
/// go: a sudden release is what leaves the most energy to a limit cycle.
#include <array>
#include <cstddef>
#include <vector>

#include "signals/operator.h"
#include "signals/simulation.h"

namespace sprung {

struct FootPull {
  double direction_rad = 0.0;  ///< in the leg's plane, from forward toward up
  double force_N = 0.0;
};

struct FootReturnScript {
  double stiffness_N_m = 0.0;  ///< both axes
  double damping_N_s_m = 0.0;
  double friction_compensation = 0.0;
  double leg_length_m = 0.450;    ///< the preset's stand: the foot hangs so far under the hip
  double hip_height_m = 1.5;      ///< no floor in reach
  std::vector<FootPull> pulls{};  ///< one after the other
};

namespace foot_return {
inline constexpr double kStand_s = 0.1;   ///< `stand`: the estimator has settled
inline constexpr double kFirst_s = 1.5;   ///< the first pull's period
inline constexpr double kCentre_s = 1.0;  ///< position control, from the begin of a pull's period
inline constexpr double kComply_s = 0.2;  ///< compliance before the hand pulls
inline constexpr double kGrow_s = 0.7;
inline constexpr double kHold_s = 0.3;
inline constexpr double kWatch_s = 2.5;
inline constexpr double kPull_s = kCentre_s + kComply_s;  ///< from the begin of the period
inline constexpr double kRelease_s = kPull_s + kGrow_s + kHold_s;
inline constexpr double kPeriod_s = kRelease_s + kWatch_s;
/// More would need more commands than wait at the planner's desk.
inline constexpr std::size_t kPullsOfARun = 5;
}  // namespace foot_return

/// Eight directions, five forces each.
std::vector<FootPull> eight_by_five(double first_force_N, double step_N);
/// The same in runs of at most kPullsOfARun pulls, in order.
std::vector<FootReturnScript> runs_of(const FootReturnScript& script);
/// What the operator says: `stand`, then `comply` and `stop` in turn.
std::vector<OperatorCommand> orders(const FootReturnScript& run, double cycle_s);
/// SIM_CONTROL of every pull, at the cycle in which it begins.
std::vector<SimControl> hand(const FootReturnScript& run, double cycle_s);

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
