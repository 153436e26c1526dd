#include "planner/planner_core.h"

#include "planner/comply_request.h"
#include "planner/motion.h"
#include "planner/motion_hold.h"
#include "planner/operator_desk.h"
#include "planner/parameter_settings.h"
#include "planner/requests.h"
#include "planner/walk_request.h"
#include "robots/maintenance.h"
#include "signals/microseconds.h"

namespace sprung {
namespace {

constexpr const char* kLapsed = "the operator's hold was not renewed: stopped";
constexpr const char* kNothingToEnable = "only in maintenance mode, for more than 0 s and at most 1 s";
constexpr const char* kNotHeld = "maintenance mode: nobody holds; sprung hold, in another terminal";
constexpr const char* kOnlyOff = "maintenance mode: only while the robot is off";
constexpr const char* kNotMaintained = "maintenance mode: the robot neither jumps nor walks";

bool leaves_the_floor(OperatorKind kind) noexcept {
  return kind == OperatorKind::kJump || kind == OperatorKind::kLand || kind == OperatorKind::kWalk;
}
bool moves(OperatorKind kind) noexcept {
  return kind == OperatorKind::kStand || kind == OperatorKind::kComply || kind == OperatorKind::kMoveJoint;
}

/// A request that has been accepted and has not ended.
struct Active {
  std::int64_t request_id = 0;
  OperatorKind kind = OperatorKind::kNone;  ///< kNone: there is none
};

}  // namespace

struct PlannerCore::Impl {
  Impl(const RobotConfig& robot, const PresetConfig& preset_in)
      : settings(robot, preset_in),
        why_not_standing(robot.why_not_standing()),
        hold_to_run(robot.hold_to_run),
        motion(robot, preset_in) {}

  void step(const JointState& in) noexcept;
  void execute(const OperatorCommand& command, const JointState& in) noexcept;
  void stand(const OperatorCommand& command, const JointState& in) noexcept;
  void jump(const OperatorCommand& command, const JointState& in) noexcept;
  void sit(const OperatorCommand& command, const JointState& in) noexcept;
  void land(const OperatorCommand& command, const JointState& in) noexcept;
  void comply(const OperatorCommand& command, const JointState& in) noexcept;
  void walk(const OperatorCommand& command, const JointState& in) noexcept;
  void stop(const OperatorCommand& command) noexcept;
  void move_joint(const OperatorCommand& command, const JointState& in) noexcept;
  void end_requests() noexcept;
  void renew_hold(const OperatorCommand& command) noexcept;
  void watch_hold() noexcept;
  void enable(const OperatorCommand& command) noexcept;
  void watch_enabling(const JointState& in) noexcept;
  void set_parameter(const OperatorCommand& command) noexcept;
  void read_parameter(const OperatorCommand& command) noexcept;
  void follow_parameters(const JointState& in) noexcept;
  const char* why_not_maintained(OperatorKind kind) const noexcept;

  void accept(const OperatorCommand& command, Active& as) noexcept {
    as = {command.request_id, command.kind};
    hold.forget();
    lapsed = released = false;
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

  const PresetConfig& preset() const noexcept { return settings.acting().preset; }
  WalkRequest walk_asked(const OperatorCommand& command) const noexcept {
    return walk_request(command, preset(), settings.acting().gaits);
  }

  ParameterSettings settings;
  const char* const why_not_standing;  ///< nullptr: it can
  const bool hold_to_run;
  Motion motion;
  OperatorDesk desk;
  MotionHold hold;
  std::int64_t enabled_until_us = -1;  ///< hold_to_run: by the operator's last word
  bool released = false;               ///< and what moved was stopped for it
  bool lapsed = false;                 ///< until the next request
  OperatorCommand going_on;            ///< the last walk or comply that was accepted
  Active moving;                       ///< stand, jump, sit or a joint move
  Active stopping;                     ///< stop
  Stamp now;
  bool started = false;
  SafetyLevel safety = SafetyLevel::kOperational;
  const char* note = "";  ///< last refusal, until the next transition or another level of safety
};

void PlannerCore::Impl::step(const JointState& in) noexcept {
  const bool restarted = started && in.stamp.seq < now.seq;
  started = true;
  now = in.stamp;
  if (in.safety != safety) note = "";  // what was refused for it is no longer true
  safety = in.safety;
  const char* before = motion.last_transition();
  const MotionPhase state_before = motion.state();
  OperatorCommand command;
  if (restarted) {
    motion.restart(in);
    while (desk.take_any(command)) refuse(command, "the bridge was restarted: send it again");
  }
  motion.update(in);
  end_requests();
  watch_hold();
  watch_enabling(in);
  while (desk.take_due(now.seq, command)) execute(command, in);
  follow_parameters(in);
  if (motion.state() != state_before || motion.last_transition() != before) note = "";
  if (lapsed) note = kLapsed;
}

void PlannerCore::Impl::execute(const OperatorCommand& command, const JointState& in) noexcept {
  if (const char* why = why_not_maintained(command.kind)) return refuse(command, why);
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
      return comply(command, in);
    case OperatorKind::kLand:
      return land(command, in);
    case OperatorKind::kWalk:
      return walk(command, in);
    case OperatorKind::kHold:
      return renew_hold(command);
    case OperatorKind::kEnable:
      return enable(command);
    case OperatorKind::kSetParameter:
      return set_parameter(command);
    case OperatorKind::kReadParameter:
      return read_parameter(command);
    case OperatorKind::kNone:
      break;
  }
  refuse(command, "unknown command");
}

void PlannerCore::Impl::stand(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  if (motion.state() == MotionPhase::kStanding) return accept_as_done(command, "already standing");
  if (motion.state() != MotionPhase::kIdle) return refuse(command, busy(motion.state()));
  if (const char* why = why_not_risen(in)) return refuse(command, why);
  if (const char* why = motion.why_not_up(in)) return refuse(command, why);
  if (motion.stand(in)) accept(command, moving);
}

void PlannerCore::Impl::jump(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  if (motion.state() != MotionPhase::kStanding) return refuse(command, busy(motion.state()));
  if (const char* refusal = validate_jump(command)) return refuse(command, refusal);
  const JumpRequest request{command.jump_mode, command.jump_count, command.jump_height_m,
                            command.jump_forward_m};
  if (const char* refusal = motion.validate_jump(request)) return refuse(command, refusal);
  if (motion.jump(in, request)) accept(command, moving);
}

void PlannerCore::Impl::land(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  if (motion.state() != MotionPhase::kStanding) return refuse(command, busy(motion.state()));
  if (!preset().jumps()) return refuse(command, "this preset has no landing: the robot does not jump");
  if (const char* refusal = validate_land(command)) return refuse(command, refusal);
  if (motion.land(in, {command.jump_mode, command.touchdown_in_s})) accept(command, moving);
}

/// Done as soon as it is accepted: it lasts until `stop` or `sit`.
void PlannerCore::Impl::comply(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  const bool possible = motion.state() == MotionPhase::kStanding || motion.state() == MotionPhase::kComplying;
  if (!possible) return refuse(command, busy(motion.state()));
  if (stopping.kind != OperatorKind::kNone) return refuse(command, "already stopping");
  if (const char* refusal = validate_comply(command, preset())) return refuse(command, refusal);
  if (const char* refusal = MotionHold::validate(command.hold_s)) return refuse(command, refusal);
  if (motion.comply(in, comply_request(command, preset()))) {
    note = "";
    lapsed = released = false;
    hold.begin(command.hold_s, now.utime_us);
    going_on = command;
    accept_as_done(command, motion.last_transition());
  }
}

/// Done as soon as it is accepted: it lasts until `stop`. A walk that ends by itself says why in
/// MOTION_STATE.
void PlannerCore::Impl::walk(const OperatorCommand& command, const JointState& in) noexcept {
  if (why_not_standing != nullptr) return refuse(command, why_not_standing);
  const bool possible = motion.state() == MotionPhase::kStanding || motion.state() == MotionPhase::kWalking;
  if (!possible) return refuse(command, busy(motion.state()));
  if (stopping.kind != OperatorKind::kNone) return refuse(command, "already stopping");
  const WalkRequest request = walk_asked(command);
  if (const char* refusal = motion.validate_walk(request)) return refuse(command, refusal);
  if (const char* refusal = MotionHold::validate(command.hold_s)) return refuse(command, refusal);
  if (motion.walk(in, request)) {
    note = "";
    lapsed = released = false;
    hold.begin(command.hold_s, now.utime_us);
    going_on = command;
    accept_as_done(command, motion.last_transition());
  }
}

void PlannerCore::Impl::sit(const OperatorCommand& command, const JointState& in) noexcept {
  if (motion.state() == MotionPhase::kIdle) return accept_as_done(command, "already down, drives off");
  const bool possible = motion.state() == MotionPhase::kStanding ||
                        motion.state() == MotionPhase::kMovingJoint ||
                        motion.state() == MotionPhase::kComplying;
  if (!possible) return refuse(command, busy(motion.state()));
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
  if (const char* refusal = motion.joints().validate(request)) return refuse(command, refusal);
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

/// Answered without a note: it is said several times a second.
void PlannerCore::Impl::renew_hold(const OperatorCommand& command) noexcept {
  const bool good = MotionHold::validate(command.hold_s) == nullptr &&
                    hold.renew(command.hold_s, now.utime_us);
  if (good) return accept_as_done(command, "held");
  desk.reply(command.request_id, OperatorOutcome::kRefused, "nothing is held", now);
}

/// A motion that ends by itself ends its hold.
void PlannerCore::Impl::watch_hold() noexcept {
  const bool moves = motion.state() == MotionPhase::kWalking || motion.state() == MotionPhase::kComplying;
  if (!moves) return hold.forget();
  if (!hold.take_lapse(now.utime_us) || stopping.kind != OperatorKind::kNone) return;
  motion.halt();
  lapsed = true;
}

/// It begins to act in this cycle. A refusal is no word on the motion.
void PlannerCore::Impl::set_parameter(const OperatorCommand& command) noexcept {
  const ParameterNews asked{command.parameter, command.parameter_value};
  const bool held_up = hold_to_run && motion.state() != MotionPhase::kIdle;
  const char* why = held_up ? kOnlyOff
                            : settings.why_not(command.parameter, command.parameter_value, motion.state());
  if (why != nullptr) return desk.reply(command.request_id, OperatorOutcome::kRefused, why, now, asked);
  settings.set(command.parameter, command.parameter_value, now.utime_us);
  desk.reply(command.request_id, OperatorOutcome::kAccepted, "", now, asked);
  desk.reply(command.request_id, OperatorOutcome::kDone, "set", now, asked);
}

void PlannerCore::Impl::read_parameter(const OperatorCommand& command) noexcept {
  const auto found = settings.next_changed(command.parameter);
  if (!found) return desk.reply(command.request_id, OperatorOutcome::kRefused, kNoSuchParameter, now);
  const ParameterNews news{found->id, found->id != 0 ? found->value : kNaN};
  desk.reply(command.request_id, OperatorOutcome::kAccepted, "", now, news);
  desk.reply(command.request_id, OperatorOutcome::kDone, "read", now, news);
}

/// What is under way has gains, heights and limits of its own, where it was asked for without.
void PlannerCore::Impl::follow_parameters(const JointState& in) noexcept {
  if (!settings.advance(now.utime_us)) return;
  motion.adjust(in, settings.acting());
  if (motion.state() == MotionPhase::kComplying) motion.change_compliance(comply_request(going_on, preset()));
  if (motion.state() == MotionPhase::kWalking) motion.change_walk(walk_asked(going_on));
}

/// As renew_hold(); each is no word for the other.
void PlannerCore::Impl::enable(const OperatorCommand& command) noexcept {
  const bool good = hold_to_run && command.hold_s > 0.0 && command.hold_s <= kLongestHoldToRun_s;
  if (!good) return desk.reply(command.request_id, OperatorOutcome::kRefused, kNothingToEnable, now);
  enabled_until_us = now.utime_us + to_us(command.hold_s);
  accept_as_done(command, "enabled");
}

/// What moves stops where it is; half a rise cannot be held, and is damped.
void PlannerCore::Impl::watch_enabling(const JointState& in) noexcept {
  if (!hold_to_run || now.utime_us <= enabled_until_us) return;
  if (motion.let_go(in)) {
    end(moving, OperatorOutcome::kFailed, motion.last_transition());
    end(stopping, OperatorOutcome::kFailed, motion.last_transition());
  }
  const bool joint_moves = motion.state() == MotionPhase::kMovingJoint && !motion.joints_held();
  if (!joint_moves && motion.state() != MotionPhase::kComplying) return;
  if (stopping.kind == OperatorKind::kNone && !released) motion.stop();
  released = true;
}

const char* PlannerCore::Impl::why_not_maintained(OperatorKind kind) const noexcept {
  if (!hold_to_run) return nullptr;
  if (leaves_the_floor(kind)) return kNotMaintained;
  return moves(kind) && now.utime_us > enabled_until_us ? kNotHeld : nullptr;
}

/// Requests end where the motion rests: standing, idle, or with single joints held.
void PlannerCore::Impl::end_requests() noexcept {
  const char* why = motion.last_transition();
  if (motion.state() == MotionPhase::kIdle) {
    const bool sat = moving.kind == OperatorKind::kSit && motion.sat();
    end(moving, sat ? OperatorOutcome::kDone : OperatorOutcome::kFailed, why);
    end(stopping, OperatorOutcome::kFailed, why);
  } else if (motion.state() == MotionPhase::kStanding) {
    const bool jumped = moving.kind == OperatorKind::kJump || moving.kind == OperatorKind::kLand;
    const char* failure = jumped ? motion.jump_failure() : nullptr;
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
