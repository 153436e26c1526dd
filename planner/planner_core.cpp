#include "planner/planner_core.h"

#include <cmath>

#include "planner/motion.h"
#include "planner/operator_desk.h"

namespace sprung {
namespace {

constexpr int kMostJumps = 100;

/// A request that has been accepted and has not ended.
struct Active {
  std::int64_t request_id = 0;
  OperatorKind kind = OperatorKind::kNone;  ///< kNone: there is none
};

bool known(JumpMode mode) noexcept {
  return mode == JumpMode::kPosition || mode == JumpMode::kTorque || mode == JumpMode::kHybrid;
}

constexpr const char* kNotOperational = "safety is not operational: clear it first";
constexpr const char* kNotReady = "a joint is not ready: see its status";

/// An estimator that still settles is fine: every motion waits for it.
bool usable(JointStatus status) noexcept {
  return status == JointStatus::kOk || status == JointStatus::kSaturated || status == JointStatus::kStarting;
}

bool can_stand(const JointState& in) noexcept {
  for (const EstimatedJoint& joint : in.joints) {
    if (!usable(joint.status)) return false;
  }
  for (const EstimatedLeg& leg : in.legs) {
    if (!std::isfinite(leg.estimated_foot_in_hip_m[0])) return false;
  }
  return true;
}

/// nullptr: every joint can be held where it is.
const char* why_not_held(const JointState& in) noexcept {
  if (in.safety != SafetyLevel::kOperational) return kNotOperational;
  for (const EstimatedJoint& joint : in.joints) {
    if (joint.status == JointStatus::kNotReferenced) return "a joint is not referenced: sprung home";
    if (!usable(joint.status)) return kNotReady;
  }
  return nullptr;
}

const char* busy(MotionPhase state) noexcept {
  switch (state) {
    case MotionPhase::kStanding:
      return "busy: standing, sit first";
    case MotionPhase::kMovingJoint:
      return "busy: single joints are held, sit first";
    case MotionPhase::kRising:
      return "busy: rising";
    case MotionPhase::kSitting:
      return "busy: sitting down";
    case MotionPhase::kIdle:
      return "not standing: stand first";
    default:
      return "busy: jumping";
  }
}

/// nullptr: fine.
const char* jump_mistake(const OperatorCommand& c, const JumpCurveConfig& curve) noexcept {
  if (!known(c.jump_mode)) return "jump mode must be position, torque or hybrid";
  if (c.jump_count < 1 || c.jump_count > kMostJumps) return "jump count must be 1 to 100";
  if (std::isnan(jump_scale(curve, c.jump_height_m)))
    return "jump height must be 0.02 m to 1.1 times the robot file's own, or 0 for that";
  return nullptr;
}

}  // namespace

struct PlannerCore::Impl {
  Impl(const RobotConfig& robot, const PresetConfig& preset)
      : jump_curve(preset.jump_curve), why_not_standing(robot.why_not_standing()), motion(robot, preset) {}

  void step(const JointState& in) noexcept;
  void execute(const OperatorCommand& command, const JointState& in) noexcept;
  void stand(const OperatorCommand& command, const JointState& in) noexcept;
  void jump(const OperatorCommand& command, const JointState& in) noexcept;
  void sit(const OperatorCommand& command, const JointState& in) noexcept;
  void stop(const OperatorCommand& command) noexcept;
  void move_joint(const OperatorCommand& command, const JointState& in) noexcept;
  void end_requests() noexcept;

  void accept(const OperatorCommand& command, Active& as) noexcept {
    as = {command.request_id, command.kind};
    desk.reply(command.request_id, OperatorOutcome::kAccepted, "", now);
    note = "";
  }
  void accept_as_done(const OperatorCommand& command, const char* reason) noexcept {
    desk.reply(command.request_id, OperatorOutcome::kAccepted, "", now);
    desk.reply(command.request_id, OperatorOutcome::kDone, reason, now);
  }
  void refuse(const OperatorCommand& command, const char* reason) noexcept {
    desk.reply(command.request_id, OperatorOutcome::kRefused, reason, now);
    note = reason;
  }
  void end(Active& request, OperatorOutcome outcome, const char* reason) noexcept {
    if (request.kind != OperatorKind::kNone) desk.reply(request.request_id, outcome, reason, now);
    request = {};
  }

  const JumpCurveConfig jump_curve;    ///< the robot file's own
  const char* const why_not_standing;  ///< nullptr: it can
  Motion motion;
  OperatorDesk desk;
  Active moving;    ///< stand, jump, sit or a joint move
  Active stopping;  ///< stop
  Stamp now;
  bool started = false;
  const char* note = "";  ///< last refusal, until the next transition
};

void PlannerCore::Impl::step(const JointState& in) noexcept {
  const bool restarted = started && in.stamp.seq < now.seq;
  started = true;
  now = in.stamp;
  const char* before = motion.last_transition();
  const MotionPhase state_before = motion.state();
  OperatorCommand command;
  if (restarted) {
    motion.restart(in);
    while (desk.take_any(command)) refuse(command, "the bridge was restarted: send it again");
  }
  motion.update(in);
  end_requests();
  while (desk.take_due(now.seq, command)) execute(command, in);
  if (motion.state() != state_before || motion.last_transition() != before) note = "";
}

void PlannerCore::Impl::execute(const OperatorCommand& command, const JointState& in) noexcept {
  switch (command.kind) {
    case OperatorKind::kStand:
      return stand(command, in);
    case OperatorKind::kJump:
      return jump(command, in);
    case OperatorKind::kSit:
      return sit(command, in);
    case OperatorKind::kStop:
      return stop(command);
    case OperatorKind::kEstop:
    case OperatorKind::kClear:
    case OperatorKind::kHome:
      return;  // the bridge's own, and it answers them
    case OperatorKind::kMoveJoint:
      return move_joint(command, in);
    case OperatorKind::kComply:
    case OperatorKind::kLand:
    case OperatorKind::kNone:
      break;
  }
  refuse(command, "unknown command");
}

void PlannerCore::Impl::stand(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  if (motion.state() == MotionPhase::kStanding) return accept_as_done(command, "already standing");
  if (motion.state() != MotionPhase::kIdle) return refuse(command, busy(motion.state()));
  if (in.safety != SafetyLevel::kOperational) return refuse(command, kNotOperational);
  if (!can_stand(in)) return refuse(command, kNotReady);
  if (motion.stand(in)) accept(command, moving);
}

void PlannerCore::Impl::jump(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  if (motion.state() != MotionPhase::kStanding) return refuse(command, busy(motion.state()));
  if (const char* mistake = jump_mistake(command, jump_curve)) return refuse(command, mistake);
  const JumpRequest request{command.jump_mode, command.jump_count,
                            jump_scale(jump_curve, command.jump_height_m)};
  if (motion.jump(in, request)) accept(command, moving);
}

void PlannerCore::Impl::sit(const OperatorCommand& command, const JointState& in) noexcept {
  if (motion.state() == MotionPhase::kIdle) return accept_as_done(command, "already down, drives off");
  const bool joints = motion.state() == MotionPhase::kMovingJoint;
  if (motion.state() != MotionPhase::kStanding && !joints) return refuse(command, busy(motion.state()));
  if (!motion.sit(in)) return;
  end(moving, OperatorOutcome::kFailed, motion.last_transition());
  end(stopping, OperatorOutcome::kFailed, motion.last_transition());
  accept(command, moving);
}

void PlannerCore::Impl::move_joint(const OperatorCommand& command, const JointState& in) noexcept {
  const bool held = motion.state() == MotionPhase::kMovingJoint;
  if (held && !motion.joints_held()) return refuse(command, "busy: a joint is moving");
  if (!held && motion.state() != MotionPhase::kIdle) return refuse(command, busy(motion.state()));
  if (const char* why = why_not_held(in)) return refuse(command, why);
  const JointRequest request{command.joint, command.joint_target_rad, command.joint_speed_rad_s,
                             command.joint_acceleration_rad_s2};
  if (const char* mistake = motion.joints().mistake(request)) return refuse(command, mistake);
  if (motion.move_joint(in, request)) accept(command, moving);
}

void PlannerCore::Impl::stop(const OperatorCommand& command) noexcept {
  if (motion.state() == MotionPhase::kIdle) return accept_as_done(command, "nothing moves");
  if (motion.state() == MotionPhase::kStanding) return accept_as_done(command, "standing");
  const bool held = motion.state() == MotionPhase::kMovingJoint && motion.joints_held();
  if (held) return accept_as_done(command, "joints are held");
  if (motion.state() == MotionPhase::kSitting) return refuse(command, busy(motion.state()));
  if (stopping.kind != OperatorKind::kNone) return refuse(command, "already stopping");
  motion.stop();
  accept(command, stopping);
}

/// Requests end where the motion rests: standing, idle, or with single joints held.
void PlannerCore::Impl::end_requests() noexcept {
  const char* why = motion.last_transition();
  if (motion.state() == MotionPhase::kIdle) {
    const bool sat = moving.kind == OperatorKind::kSit && motion.sat();
    end(moving, sat ? OperatorOutcome::kDone : OperatorOutcome::kFailed, why);
    end(stopping, OperatorOutcome::kFailed, why);
  } else if (motion.state() == MotionPhase::kStanding) {
    const char* failure = moving.kind == OperatorKind::kJump ? motion.jump_failure() : nullptr;
    end(moving, failure != nullptr ? OperatorOutcome::kFailed : OperatorOutcome::kDone,
        failure != nullptr ? failure : why);
    end(stopping, OperatorOutcome::kDone, why);
  } else if (motion.state() == MotionPhase::kMovingJoint && motion.joints_held()) {
    end(moving, motion.joint_stopped() ? OperatorOutcome::kFailed : OperatorOutcome::kDone, why);
    end(stopping, OperatorOutcome::kDone, why);
  }
}

PlannerCore::PlannerCore(const RobotConfig& robot, const PresetConfig& preset)
    : impl_(std::make_unique<Impl>(robot, preset)) {}

PlannerCore::~PlannerCore() = default;

bool PlannerCore::submit(const OperatorCommand& command) noexcept { return impl_->desk.submit(command); }

void PlannerCore::step(const JointState& in, LegCommand& leg_out, MotionState& motion_out) noexcept {
  impl_->step(in);
  impl_->motion.write(in, leg_out);
  impl_->motion.write(motion_out);
  motion_out.stamp = in.stamp;
  if (impl_->note[0] != '\0') motion_out.last_transition = impl_->note;
}

bool PlannerCore::next_reply(OperatorReply& out) noexcept { return impl_->desk.next_reply(out); }

}  // namespace sprung
