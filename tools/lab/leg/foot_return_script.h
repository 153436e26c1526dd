#pragma once
/// What is done to the leg in `sprung experiment foot_return`: it hangs, its foot on a virtual spring, and a
/// hand pulls the foot away and lets go (S0 section V-A, Figs. 8 and 9). Pure.
///
/// Each pull, in its period of kPeriod_s, by the operator's commands alone: after the first, `stop` lets the
/// position loops bring the foot back to the stand pose; `comply`; the force grows in a straight line, is
/// held, and is gone at once; then the foot is watched. S0 does not say how its hand let go: a sudden release
/// is what leaves the most energy to a limit cycle.
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

}  // namespace sprung
