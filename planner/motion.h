#pragma once
/// The motion itself: feeds measured conditions and time-outs to the state machine, and draws the feet's
/// paths in each state. All legs do the same. Pure: no heap after construction, never throws in step; time is
/// the message's.
#include <vector>

#include "planner/foot_move.h"
#include "planner/joint_motion.h"
#include "planner/jump_curve.h"
#include "planner/leg_gains.h"
#include "planner/motion_state_machine.h"

namespace sprung {

/// Drives that are not all enabled this long after `stand` will not be (design section 8: nothing is
/// retried).
inline constexpr double kEnableTimeout_s = 1.5;
/// Contact counts as touchdown only this long after the curve ended: until then the leg's own deceleration
/// can look like it.
inline constexpr double kTouchdownGuard_s = 0.05;

/// How long legs are damped after safety, a drive or the foot was lost: a standing leg then sinks instead of
/// falling. Only after that is it without power.
inline constexpr double kSinkTime_s = 1.0;

/// A thrust has ended when the leg, once extended by this share of its stroke, is shorter again by this length.
inline constexpr double kExtended = 0.5;
inline constexpr double kDrawnIn_m = 0.005;

struct JumpRequest {
  JumpMode mode = JumpMode::kHybrid;
  int count = 1;
  double scale = 1.0;
};

class Motion {
 public:
  /// @throws std::invalid_argument on a jump curve that cannot be.
  Motion(const RobotConfig& robot, const PresetConfig& preset);

  MotionPhase state() const noexcept { return machine_.state(); }
  const char* last_transition() const noexcept;

  // Requests of the operator, each only where the state machine has a transition for it; @return false
  // elsewhere.
  bool stand(const JointState& in) noexcept;
  bool jump(const JointState& in, const JumpRequest& request) noexcept;
  bool sit(const JointState& in) noexcept;
  /// From idle, or where joints are held and none moves.
  bool move_joint(const JointState& in, const JointRequest& request) noexcept;
  /// Finish the phase, then stand: no thrust any more if it has not begun, no further jumps. A joint that moves
  /// brakes, and all are held.
  void stop() noexcept;
  /// The bridge was restarted: off at once.
  void restart(const JointState& in) noexcept;

  /// One cycle of conditions and time-outs. At most one transition.
  void update(const JointState& in) noexcept;
  void write(const JointState& in, LegCommand& out) const noexcept;
  void write(MotionState& out) const noexcept;

  /// Why the jump just ended was not as requested; nullptr when it was.
  const char* jump_failure() const noexcept { return jump_failure_; }
  const JointMotion& joints() const noexcept { return joints_; }
  /// In kMovingJoint: nothing moves, nor waits for its drives.
  bool joints_held() const noexcept { return enabled_ && !joint_moves_; }
  /// The last joint move was stopped before its end.
  bool joint_stopped() const noexcept {
    return machine_.last() != nullptr && machine_.last()->event == MotionEvent::kJointStopped;
  }
  /// Idle because it sat down, not because something went wrong.
  bool sat() const noexcept {
    return machine_.last() != nullptr && machine_.last()->event == MotionEvent::kSat;
  }

 private:
  bool process(MotionEvent event, const JointState& in) noexcept;
  void enter(MotionPhase from, const JointState& in) noexcept;
  void update_rising(const JointState& in) noexcept;
  void update_crouch(const JointState& in) noexcept;
  void update_thrust(const JointState& in) noexcept;
  bool drawn_in_again(const JointState& in) noexcept;
  void update_flight(const JointState& in) noexcept;
  void update_recover(const JointState& in) noexcept;
  void update_joint(const JointState& in) noexcept;
  void await_joints(const JointState& in) noexcept;
  bool lost(const JointState& in) noexcept;
  void move_all(double length_m, double duration_s) noexcept;
  void note_departure(const JointState& in) noexcept;
  FootPoint path(std::size_t leg) const noexcept;
  void write_foot(std::size_t leg, const JointState& in, DesiredLeg& out) const noexcept;
  bool waiting() const noexcept {
    return !enabled_ && (state() == MotionPhase::kRising || state() == MotionPhase::kMovingJoint);
  }
  /// After a loss, or when single joints are let go.
  bool sinking() const noexcept {
    const bool going_down =
        state() == MotionPhase::kIdle ? lost_ : state() == MotionPhase::kSitting && let_go_;
    return going_down && in_phase_s() < kSinkTime_s;
  }
  JumpProgress progress() const noexcept;
  double in_phase_s() const noexcept { return since(phase_began_us_); }
  double since(std::int64_t utime_us) const noexcept {
    return 1e-6 * static_cast<double>(now_us_ - utime_us);
  }

  PresetConfig preset_;
  MotionStateMachine machine_;
  JumpCurve curve_;
  JointMotion joints_;
  JointRequest joint_request_;     ///< that waits for its drives
  std::vector<FootMove> moves_;    ///< one for each leg; played since move_began_us_
  std::vector<Vec3> departure_m_;  ///< where each leg's next move begins
  std::int64_t now_us_ = 0;
  std::int64_t phase_began_us_ = 0;
  std::int64_t move_began_us_ = 0;
  std::int64_t thrust_began_us_ = 0;
  bool lost_ = false;          ///< idle because something was lost, not by sitting down or a restart
  bool joint_moves_ = false;   ///< or waits for its drives
  bool let_go_ = false;        ///< sitting down from single joints: damped, since there is no foot to lower
  bool enabled_ = false;       ///< all drives have been since the stand or the first joint move was requested
  bool contact_seen_ = false;  ///< since the thrust began
  double longest_m_ = 0.0;     ///< measured leg, since the thrust began
  bool stop_ = false;
  JumpRequest request_;
  int jumps_done_ = 0;
  int jumps_left_ = 0;
  const char* jump_failure_ = nullptr;
};

}  // namespace sprung
