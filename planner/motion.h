#pragma once
/// The motion itself: feeds measured conditions and time-outs to the state machine, and draws the feet's
/// paths in each state. All legs do the same. Pure: no heap after construction, never throws in step; time is
/// the message's.
#include <vector>

#include "planner/adaptive_landing.h"
#include "planner/comply_request.h"
#include "planner/fall_detector.h"
#include "planner/fall_reflex.h"
#include "planner/foot_move.h"
#include "planner/gait/payload_estimator.h"
#include "planner/gait/walk.h"
#include "planner/joint_motion.h"
#include "planner/jump.h"
#include "planner/motion_state_machine.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/vec3.h"

namespace sprung {

/// Drives that are not all enabled this long after `stand` will not be (design section 8: nothing is
/// retried).
inline constexpr double kEnableTimeout_s = 1.5;
/// How long legs are damped after safety, a drive or the foot was lost: a standing leg then sinks instead of
/// falling. Only after that is it without power.
inline constexpr double kSinkTime_s = 1.0;

class Motion {
 public:
  /// @throws std::invalid_argument on a jump curve that cannot be.
  Motion(const RobotConfig& robot, const PresetConfig& preset);

  MotionPhase state() const noexcept { return machine_.state(); }
  /// Why the motion is where it is: the last transition; of a walk that ended by itself, why, until something
  /// else is asked for.
  const char* last_transition() const noexcept;

  // Requests of the operator, each only where the state machine has a transition for it; @return false
  // elsewhere.
  bool stand(const JointState& in) noexcept;
  /// nullptr: the robot lies so that it can.
  const char* why_not_up(const JointState& in) const noexcept { return falls_.why_not_up(in.body); }
  bool jump(const JointState& in, const JumpRequest& request) noexcept;
  /// Why not; nullptr: it can be done.
  const char* validate_jump(const JumpRequest& request) const noexcept { return jump_.validate(request); }
  /// Feet stay where they are desired now, each on a virtual spring; again: with other gains.
  bool comply(const JointState& in, const ComplyRequest& request) noexcept;
  /// Hanging in the air: a fall begins now.
  bool land(const JointState& in, const FallRequest& request) noexcept;
  /// From standing, or walking with another request.
  bool walk(const JointState& in, const WalkRequest& request) noexcept;
  const char* validate_walk(const WalkRequest& request) const noexcept {
    return walk_.validate(request, state() == MotionPhase::kWalking);
  }
  /// Of the walk that is under way, as far as its gait goes now; the rest of it stays.
  void change_walk(const WalkRequest& request) noexcept;
  /// Of the compliance that is under way.
  void change_compliance(const ComplyRequest& request) noexcept { compliance_ = request; }
  /// Parameters are others now. A robot that stands goes to its new height.
  void adjust(const JointState& in, const AdjustableConfig& config) noexcept;
  bool sit(const JointState& in) noexcept;
  /// Nobody holds (robots/maintenance.h): a rise is damped, then off. @return false: it does not rise.
  bool let_go(const JointState& in) noexcept;
  /// From idle, or where joints are held and none moves.
  bool move_joint(const JointState& in, const JointRequest& request) noexcept;
  /// Finish the phase, then stand: no thrust any more if it has not begun, no further jumps; no compliance. A
  /// joint that moves brakes, and all are held.
  void stop() noexcept;
  /// As stop(), when the operator is gone: a walk ends within Walk::kHalt_s, on feet where they are.
  void halt() noexcept;
  /// The bridge was restarted: off at once.
  void restart(const JointState& in) noexcept;

  /// One cycle of conditions and time-outs. At most one transition.
  void update(const JointState& in) noexcept;
  /// Once in each cycle, after update() and all requests.
  void write(const JointState& in, LegCommand& out) noexcept;
  void write(MotionState& out) const noexcept;

  /// Why the jump or fall that just ended was not as requested; nullptr when it was.
  const char* jump_failure() const noexcept { return jump_.failure(); }
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
  void update_jump(const JointState& in) noexcept;
  void update_recover(const JointState& in) noexcept;
  void update_joint(const JointState& in) noexcept;
  void await_joints(const JointState& in) noexcept;
  bool lost(const JointState& in) noexcept;
  bool in_place() const noexcept;
  void keep_feet() noexcept;
  void move_all(double length_m, double duration_s) noexcept;
  void update_walk(const JointState& in) noexcept;
  void weigh_rise() noexcept;
  bool fell(const JointState& in) noexcept;
  void note_departure(const JointState& in) noexcept;
  bool on_spring(std::size_t leg) const noexcept;  ///< by the last command
  FootPoint path(std::size_t leg) const noexcept;
  void write_foot(std::size_t leg, const JointState& in, DesiredLeg& out) const noexcept;
  void write_adaptive_landing(std::size_t leg, const JointState& in, DesiredLeg& out) noexcept;
  /// sprung's own landing has the legs.
  bool lands_adaptively() const noexcept {
    return jump_.mode() == JumpMode::kAdaptive &&
           (state() == MotionPhase::kFlight || state() == MotionPhase::kLanding);
  }
  bool waiting() const noexcept {
    return !enabled_ && (state() == MotionPhase::kRising || state() == MotionPhase::kMovingJoint);
  }
  /// After a loss, or when single joints are let go.
  bool sinking() const noexcept {
    const bool going_down = state() == MotionPhase::kIdle ? lost_
                                                          : state() == MotionPhase::kSitting && let_go_;
    return going_down && in_phase_s() < kSinkTime_s;
  }
  JumpProgress progress() const noexcept;
  double in_phase_s() const noexcept { return since(phase_began_us_); }
  double since(std::int64_t utime_us) const noexcept {
    return 1e-6 * static_cast<double>(now_us_ - utime_us);
  }

  PresetConfig preset_;
  MotionStateMachine machine_;
  Jump jump_;
  Walk walk_;
  PayloadEstimator payload_;
  FallDetector falls_;
  Attitude along_ground_;  ///< of a trunk so, as last walked on since it was lying
  FallReflex reflex_;
  const bool meets_falls_;  ///< else it is damped alone
  ComplyRequest compliance_;
  std::vector<AdaptiveLanding> adaptive_landing_;     ///< one for each leg
  std::vector<AdaptiveLandingOutput> adaptive_said_;  ///< in the last cycle
  JointMotion joints_;
  JointRequest joint_request_;     ///< that waits for its drives
  std::vector<FootMove> moves_;    ///< one for each leg; played since move_began_us_
  std::vector<Vec3> departure_m_;  ///< where each leg's next move begins
  std::vector<Vec3> kept_m_;       ///< where a walk left each foot, from its place; 0 where it set them
  std::int64_t now_us_ = 0;
  std::int64_t phase_began_us_ = 0;
  std::int64_t move_began_us_ = 0;
  std::int64_t sinks_from_us_ = 0;  ///< in kFallen: its legs are damped since then
  bool walk_failed_ = false;        ///< stands, or is about to, since a walk ended by itself
  bool lost_ = false;               ///< idle because something was lost, not by sitting down or a restart
  bool joint_moves_ = false;        ///< or waits for its drives
  double recover_s_ = 0.0;
  bool let_go_ = false;  ///< sitting down from single joints or half a rise: damped, since no foot can be led
  bool enabled_ = false;  ///< all drives have been since the stand or the first joint move was requested
  bool stop_ = false;
};

}  // namespace sprung
