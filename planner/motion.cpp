#include "planner/motion.h"

#include <algorithm>
#include <cmath>

#include "planner/measured.h"

namespace sprung {
namespace {

bool is_loss(MotionEvent event) noexcept {
  return event == MotionEvent::kSafetyLost || event == MotionEvent::kDriveLost ||
         event == MotionEvent::kFootLost;
}

/// [design choice] less than half of what legs in a gait do in that time.
constexpr double kInPlace_m = 0.03;
constexpr double kShortRecover_s = 0.25;
constexpr double kHeightRate_m_s = 0.05;  // mean, of a robot that stands and shall stand higher or lower

bool on_curve(MotionPhase phase) noexcept {
  return phase == MotionPhase::kThrust || phase == MotionPhase::kFlight || phase == MotionPhase::kLanding;
}

std::vector<AdaptiveLanding> adaptive_landings(const RobotConfig& robot, const PresetConfig& preset) {
  std::vector<AdaptiveLanding> out;
  for (const LegConfig& leg : robot.legs) out.emplace_back(robot, leg, preset);
  return out;
}

}  // namespace

Motion::Motion(const RobotConfig& robot, const PresetConfig& preset)
    : preset_(preset),
      jump_(robot, preset),
      walk_(robot, preset),
      payload_(robot),
      falls_(robot),
      reflex_(robot),
      meets_falls_(robot.body.meets_falls),
      adaptive_landing_(adaptive_landings(robot, preset)),
      adaptive_said_(robot.legs.size()),
      joints_(robot),
      moves_(robot.legs.size()),
      departure_m_(robot.legs.size()),
      kept_m_(robot.legs.size()) {}

bool Motion::stand(const JointState& in) noexcept {
  stop_ = false;
  return process(MotionEvent::kStandRequested, in);
}

bool Motion::jump(const JointState& in, const JumpRequest& request) noexcept {
  if (state() != MotionPhase::kStanding) return false;
  stop_ = false;
  jump_.begin(request);
  return process(MotionEvent::kJumpRequested, in);
}

bool Motion::land(const JointState& in, const FallRequest& request) noexcept {
  if (state() != MotionPhase::kStanding) return false;
  stop_ = false;
  jump_.begin(request, in.stamp.utime_us);
  return process(MotionEvent::kLandRequested, in);
}

bool Motion::comply(const JointState& in, const ComplyRequest& request) noexcept {
  if (!process(MotionEvent::kComplyRequested, in)) return false;
  stop_ = false;
  compliance_ = request;
  return true;
}

bool Motion::walk(const JointState& in, const WalkRequest& request) noexcept {
  const bool walking = state() == MotionPhase::kWalking;
  if (!process(MotionEvent::kWalkRequested, in)) return false;
  stop_ = false;
  walking ? walk_.change(request) : walk_.begin(in, request);
  return true;
}

void Motion::change_walk(const WalkRequest& request) noexcept {
  const WalkRequest& now = walk_.request();
  const WalkRequest wanted = walk_.within_limits(request);
  const bool same = wanted.speed == now.speed && wanted.height_m == now.height_m &&
                    wanted.stance_width_m == now.stance_width_m;
  if (!same && !stop_ && walk_.failure() == nullptr) walk_.change(wanted);
}

void Motion::adjust(const JointState& in, const AdjustableConfig& config) noexcept {
  const double higher_m = config.preset.stand_length_m - preset_.stand_length_m;
  preset_ = config.preset;  // of the same sizes: no heap
  falls_.adjust(config.body);
  for (AdaptiveLanding& landing : adaptive_landing_) landing.adjust(config.preset);
  walk_.adjust(config);
  if (state() != MotionPhase::kStanding || higher_m == 0.0) return;
  note_departure(in);
  move_all(preset_.stand_length_m, std::max(kShortRecover_s, std::abs(higher_m) / kHeightRate_m_s));
}

bool Motion::sit(const JointState& in) noexcept { return process(MotionEvent::kSitRequested, in); }

bool Motion::let_go(const JointState& in) noexcept { return process(MotionEvent::kLetGo, in); }

bool Motion::move_joint(const JointState& in, const JointRequest& request) noexcept {
  if (state() == MotionPhase::kMovingJoint && !joints_held()) return false;
  if (!process(MotionEvent::kJointRequested, in)) return false;
  stop_ = false;
  joint_request_ = request;
  joint_moves_ = true;
  if (enabled_) {
    joints_.begin(request, now_us_);
  } else {
    joints_.hold(in);
  }
  return true;
}

void Motion::stop() noexcept {
  stop_ = true;
  walk_.stop();
  joints_.brake(now_us_);
}

void Motion::halt() noexcept {
  stop();
  walk_.halt();
}

void Motion::restart(const JointState& in) noexcept {
  process(MotionEvent::kRestarted, in);
  lost_ = false;
  phase_began_us_ = move_began_us_ = now_us_ = in.stamp.utime_us;  // the old times mean nothing now
  jump_.restart(now_us_);
}

bool Motion::process(MotionEvent event, const JointState& in) noexcept {
  now_us_ = in.stamp.utime_us;
  note_departure(in);
  const MotionPhase from = state();
  if (machine_.process_event(event) == nullptr) return false;
  phase_began_us_ = now_us_;
  lost_ = is_loss(event);
  walk_failed_ = event == MotionEvent::kWalkEnded ? walk_.failure() != nullptr
                                                  : walk_failed_ && event == MotionEvent::kRecovered;
  enter(from, in);
  return true;
}

/// Where the next move begins: under compliance the leg is where its load has put it, and going on from the
/// desired foot would be a step; else where the path is now.
void Motion::note_departure(const JointState& in) noexcept {
  const bool adaptive = lands_adaptively();
  for (std::size_t i = 0; i < departure_m_.size(); ++i) {
    const Vec3& foot = in.legs[i].estimated_foot_in_hip_m;
    const Vec3 desired_m = adaptive ? adaptive_said_[i].desired.position_m : path(i).position_m;
    departure_m_[i] = on_spring(i) && finite(foot) ? foot : desired_m;
  }
}

bool Motion::on_spring(std::size_t leg) const noexcept {
  if (state() == MotionPhase::kIdle) return false;
  if (state() == MotionPhase::kComplying || state() == MotionPhase::kWalking) return true;
  if (lands_adaptively()) return adaptive_said_[leg].control_mode == ControlMode::kCompliance;
  return compliant(progress(), preset_);
}

void Motion::enter(MotionPhase from, const JointState& in) noexcept {
  switch (state()) {
    case MotionPhase::kIdle:
      jump_.abandon();
      reflex_.end();
      break;
    case MotionPhase::kRising:
      enabled_ = false;
      payload_.forget();
      kept_m_.assign(kept_m_.size(), Vec3{});
      break;
    case MotionPhase::kMovingJoint:
      enabled_ = enabled_ && from == MotionPhase::kMovingJoint;
      break;
    case MotionPhase::kCrouch:
      jump_.shape();
      move_all(jump_.curve().crouch_length_m(), preset_.crouch_time_s);
      break;
    case MotionPhase::kThrust:
      jump_.begin_thrust(in);
      break;
    case MotionPhase::kFlight:
      if (from == MotionPhase::kStanding) move_all(jump_.curve().end_length_m(), jump_.fall_move_s());
      for (AdaptiveLanding& adaptive : adaptive_landing_) adaptive.begin(jump_.expected());
      break;
    case MotionPhase::kRecover:
      if (from == MotionPhase::kLanding) jump_.landed();
      if (from == MotionPhase::kWalking) keep_feet();
      recover_s_ = from == MotionPhase::kWalking ? kShortRecover_s : preset_.recover_time_s;
      move_all(preset_.stand_length_m, recover_s_);
      break;
    case MotionPhase::kSitting:
      let_go_ = from == MotionPhase::kMovingJoint || from == MotionPhase::kRising;
      kept_m_.assign(kept_m_.size(), Vec3{});  // folded legs do not reach beside their places
      move_all(preset_.sit_length_m, preset_.rise_time_s);
      break;
    case MotionPhase::kStanding:
      if (from == MotionPhase::kRising) weigh_rise();
      break;
    case MotionPhase::kWalking:
    case MotionPhase::kLanding:
    case MotionPhase::kComplying:
      break;
    case MotionPhase::kFallen:
      sinks_from_us_ = now_us_;
      reflex_.end();
      if (falls_.found() == Fall::kFalls && meets_falls_)
        reflex_.begin(in, preset_.sit_length_m, preset_.stand_length_m);
      break;
  }
}

/// After a walk that set its feet.
bool Motion::in_place() const noexcept {
  for (std::size_t i = 0; i < departure_m_.size(); ++i) {
    const Vec3 place_m = walk_.stance_foot_in_hip_m(i, preset_.stand_length_m);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(std::abs(departure_m_[i][axis] - place_m[axis]) <= kInPlace_m)) return false;
  }
  return true;
}

/// A walk that was halted leaves its feet where they stand: drawn to their places they would be dragged.
void Motion::keep_feet() noexcept {
  const bool keep = !in_place();
  for (std::size_t i = 0; i < kept_m_.size(); ++i) {
    const Vec3 place_m = walk_.stance_foot_in_hip_m(i, preset_.stand_length_m);
    for (std::size_t axis = 0; axis < 3; ++axis)
      kept_m_[i][axis] = keep ? departure_m_[i][axis] - place_m[axis] : 0.0;
  }
}

void Motion::move_all(double length_m, double duration_s) noexcept {
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    Vec3 to_m = walk_.stance_foot_in_hip_m(i, length_m);
    for (std::size_t axis = 0; axis < to_m.size(); ++axis) to_m[axis] += kept_m_[i][axis];
    moves_[i] = {departure_m_[i], to_m, duration_s};
  }
  move_began_us_ = now_us_;
}

void Motion::update(const JointState& in) noexcept {
  now_us_ = in.stamp.utime_us;
  if (state() == MotionPhase::kIdle || lost(in) || fell(in)) return;
  switch (state()) {
    case MotionPhase::kRising:
      update_rising(in);
      break;
    case MotionPhase::kCrouch:
      update_crouch(in);
      break;
    case MotionPhase::kThrust:
    case MotionPhase::kFlight:
      update_jump(in);
      break;
    case MotionPhase::kLanding:
      if (in_phase_s() >= preset_.landing_hold_s) process(MotionEvent::kLandingHeld, in);
      break;
    case MotionPhase::kRecover:
      update_recover(in);
      break;
    case MotionPhase::kSitting:
      if (in_phase_s() >= (let_go_ ? kSinkTime_s : preset_.rise_time_s)) process(MotionEvent::kSat, in);
      break;
    case MotionPhase::kMovingJoint:
      update_joint(in);
      break;
    case MotionPhase::kComplying:
      if (stop_) process(MotionEvent::kStopped, in);
      break;
    case MotionPhase::kWalking:
      update_walk(in);
      break;
    case MotionPhase::kFallen:
      reflex_.step(in);
      if (reflex_.acts()) sinks_from_us_ = now_us_;
      if (since(sinks_from_us_) >= kSinkTime_s) process(MotionEvent::kSat, in);
      break;
    case MotionPhase::kIdle:
    case MotionPhase::kStanding:
      break;
  }
}

/// What was carried before the rise counts no more, also where it could not be weighed.
void Motion::weigh_rise() noexcept {
  payload_.rise_ended();
  walk_.carry(payload_.used());
}

void Motion::update_walk(const JointState& in) noexcept {
  walk_.step(in);
  payload_.add(in, walk_.view());
  if (walk_.whole_period_ended()) {
    if (payload_.period_ended()) walk_.carry(payload_.used());
  } else if (walk_.period_begins()) {
    payload_.begin_anew();
  }
  if (walk_.ended()) process(MotionEvent::kWalkEnded, in);
}

bool Motion::fell(const JointState& in) noexcept {
  const bool upright = state() == MotionPhase::kStanding || state() == MotionPhase::kWalking ||
                       state() == MotionPhase::kComplying || state() == MotionPhase::kRecover;
  const bool walks = state() == MotionPhase::kWalking;
  if (!upright) {
    falls_.begin_anew();
    along_ground_ = {};
  }
  if (walks) along_ground_ = walk_.wanted_trunk();
  return upright && falls_.step(in, walks ? walk_.swing_s() : -1.0, along_ground_) != Fall::kNone &&
         process(MotionEvent::kFell, in);
}

bool Motion::lost(const JointState& in) noexcept {
  if (in.safety != SafetyLevel::kOperational) return process(MotionEvent::kSafetyLost, in);
  if (any_fault(in) || (!waiting() && !all_enabled(in))) return process(MotionEvent::kDriveLost, in);
  return false;
}

void Motion::update_rising(const JointState& in) noexcept {
  if (!enabled_) {
    if (in_phase_s() >= kEnableTimeout_s) process(MotionEvent::kEnableTimeout, in);
    if (!all_enabled(in) || !all_settled(in) || state() != MotionPhase::kRising) return;
    for (std::size_t i = 0; i < moves_.size(); ++i) departure_m_[i] = in.legs[i].estimated_foot_in_hip_m;
    if (!std::all_of(departure_m_.begin(), departure_m_.end(), finite)) {
      process(MotionEvent::kFootLost, in);
      return;
    }
    enabled_ = true;
    move_all(preset_.stand_length_m, preset_.rise_time_s);
  }
  payload_.add_rise(in);
  if (since(move_began_us_) >= preset_.rise_time_s) process(MotionEvent::kRisen, in);
}

void Motion::update_crouch(const JointState& in) noexcept {
  if (stop_) {
    process(MotionEvent::kStopped, in);
  } else if (in_phase_s() >= preset_.crouch_time_s + preset_.settle_time_s) {
    process(MotionEvent::kCrouched, in);
  }
}

/// Thrust or flight; a time-out fails the jump.
void Motion::update_jump(const JointState& in) noexcept {
  const std::optional<MotionEvent> event = state() == MotionPhase::kThrust
                                               ? jump_.in_thrust(in, in_phase_s())
                                               : jump_.in_flight(in, in_phase_s());
  if (!event || !process(*event, in)) return;
  const bool timed_out = *event == MotionEvent::kThrustTimeout || *event == MotionEvent::kFlightTimeout;
  if (timed_out) jump_.fail(last_transition());
}

void Motion::update_recover(const JointState& in) noexcept {
  if (in_phase_s() < recover_s_ + preset_.settle_time_s) return;
  const bool again = jump_.left() > 0 && !stop_ && jump_.failure() == nullptr;
  if (jump_.left() > 0 && stop_) jump_.fail("stopped by the operator before its last jump");
  process(again ? MotionEvent::kNextJump : MotionEvent::kRecovered, in);
}

void Motion::update_joint(const JointState& in) noexcept {
  if (!enabled_) await_joints(in);
  if (!enabled_ || !joint_moves_ || !joints_.at_rest(now_us_)) return;
  joint_moves_ = false;
  process(stop_ ? MotionEvent::kJointStopped : MotionEvent::kJointArrived, in);
}

void Motion::await_joints(const JointState& in) noexcept {
  const bool measured = joints_.hold(in);
  if (measured && all_enabled(in) && all_settled(in)) {
    enabled_ = true;
    if (!stop_) joints_.begin(joint_request_, now_us_);
  } else if (in_phase_s() >= kEnableTimeout_s) {
    process(MotionEvent::kEnableTimeout, in);
  }
}

JumpProgress Motion::progress() const noexcept { return jump_.progress(state(), in_phase_s(), now_us_); }

FootPoint Motion::path(std::size_t leg) const noexcept {
  return on_curve(state()) && !jump_.falling() ? jump_.path(now_us_) : moves_[leg].at(since(move_began_us_));
}

}  // namespace sprung
