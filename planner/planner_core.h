#pragma once
/// Motion state machine: idle, rising, standing, crouch, thrust, flight, landing, recover, sitting, moving
/// joint; foot paths for each leg, or angles for each joint. Pure: no I/O, clock, log or heap in step. Time
/// is the message's.
#include <memory>

#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"

namespace sprung {

class PlannerCore {
 public:
  PlannerCore(const RobotConfig& robot, const PresetConfig& preset);
  ~PlannerCore();
  PlannerCore(const PlannerCore&) = delete;
  PlannerCore& operator=(const PlannerCore&) = delete;

  /// Hands over an operator's command; it takes effect in the step of apply_at_seq, or in the next one. At
  /// most 16 wait. A request_id that was seen before is answered again and not executed again.
  /// @return false when the queue is full (the caller replies "refused: too many commands wait").
  bool submit(const OperatorCommand& command) noexcept;

  /// LEG_COMMAND(k) and MOTION_STATE(k) from JOINT_STATE(k).
  void step(const JointState& in, LegCommand& leg_out, MotionState& motion_out) noexcept;

  /// Replies since the last call: accepted or refused in the step where it took effect, done or failed when
  /// it ended.
  /// @return false when there is none left.
  bool next_reply(OperatorReply& out) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
