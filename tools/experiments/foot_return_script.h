#pragma once
/// What is done to the leg in `sprung experiment foot_return`: it hangs, its foot on a virtual spring, and a hand pulls the foot away
/// and lets go (S0 section V-A, Figs. 8 and 9). Pure.
///
/// Each pull, in its period of kPeriod_s: the position loops bring the foot to its place; compliance; the force grows in a straight
/// line, is held, and is gone at once; then the foot is watched. S0 does not say how its hand let go: a sudden release is what
/// leaves the most energy to a limit cycle.
#include <cstdint>
#include <vector>

#include "planner/foot_move.h"
#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

struct FootPull {
  double direction_rad = 0.0;  ///< in the leg's plane, from forward toward up
  double force_N = 0.0;
};

struct FootReturnScript {
  double stiffness_N_m = 0.0;  ///< both axes
  double damping_N_s_m = 0.0;
  double friction_compensation = 0.0;
  double leg_length_m = 0.450;    ///< the foot hangs under the hip
  double hip_height_m = 1.5;      ///< no floor in reach
  std::vector<FootPull> pulls{};  ///< one after the other
};

namespace foot_return {
inline constexpr double kFirst_s = 1.5;   ///< drives on, leg to its length
inline constexpr double kCentre_s = 0.5;  ///< position control, from the begin of a pull's period
inline constexpr double kComply_s = 0.2;  ///< compliance before the hand pulls
inline constexpr double kGrow_s = 0.7;
inline constexpr double kHold_s = 0.3;
inline constexpr double kWatch_s = 2.5;
inline constexpr double kPull_s = kCentre_s + kComply_s;  ///< from the begin of the period
inline constexpr double kRelease_s = kPull_s + kGrow_s + kHold_s;
inline constexpr double kPeriod_s = kRelease_s + kWatch_s;
}  // namespace foot_return

/// Eight directions, five forces each.
std::vector<FootPull> eight_by_five(double first_force_N, double step_N);
/// SIM_CONTROL of every pull, at the cycle in which it begins.
std::vector<SimControl> hand(const FootReturnScript& script, double cycle_s);

/// The planner's part: LEG_COMMAND(k) from JOINT_STATE(k).
class HangingLeg {
 public:
  HangingLeg(const FootReturnScript& script, double velocity_feedforward)
      : script_(script), velocity_feedforward_(velocity_feedforward) {}
  void command(const JointState& in, LegCommand& out) noexcept;

 private:
  void follow(const JointState& in, DesiredLeg& leg) noexcept;

  FootReturnScript script_;
  double velocity_feedforward_;
  std::int64_t began_us_ = -1;
  int move_of_pull_ = -2;  ///< -1: the way to the first
  FootMove move_;
};

}  // namespace sprung
