#pragma once
/// Script of a suspended leg that steps in place: the desired foot for the leg controller instead of a
/// planner's, and the floor's height for each step. Deterministic by its seed. A real swing ends when contact
/// is reported, so this one does; else it goes on to its lowest point, waits there and comes back.
#include <cstdint>

#include "planner/foot_move.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"

namespace sprung {

struct SteppingScript {
  std::uint64_t seed = 1;
  int steps = 60;
  double hip_height_m = 0.46;    ///< of the suspended base, so the leg's length on a floor at 0
  double top_m = 0.32;           ///< leg's length between two steps
  double lowest_m = 0.52;        ///< where a swing without contact ends
  double floor_spread_m = 0.03;  ///< floor is in +- this
  double foot_spread_m = 0.05;   ///< foot is in +- this of being under the hip
  double share_without_floor = 0.1;
};

class SteppingLeg {
 public:
  explicit SteppingLeg(const SteppingScript& script) : script_(script) {}

  /// LEG_COMMAND(k) from JOINT_STATE(k), as the planner's. All legs do the same.
  void command(const JointState& in, LegCommand& out) noexcept;
  /// In the first cycle of a step: its floor is to be moved now.
  bool step_begins() const noexcept { return step_begins_; }
  double floor_height_m() const noexcept;
  /// The foot is up again after the last step.
  bool done() const noexcept { return step_ >= script_.steps; }

 private:
  enum class Phase { kEnabling, kLifting, kWaitingAbove, kDescending, kWaitingBelow };
  void follow(const JointState& in) noexcept;
  void descend(double dt_s) noexcept;
  void enter(Phase phase) noexcept;
  void start_lift(double duration_s) noexcept;
  void start_step() noexcept;
  /// Of this step, uniform.
  double draw(int quantity, double low, double high) const noexcept;
  double drawn_speed_m_s() const noexcept;

  SteppingScript script_;
  Phase phase_ = Phase::kEnabling;
  int step_ = -1;  ///< -1: on the way to the first
  bool step_begins_ = false;
  double in_phase_s_ = 0.0;
  std::int64_t last_us_ = -1;
  FootMove lift_;
  FootPoint foot_;
};

}  // namespace sprung
