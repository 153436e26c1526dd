#include "planner/motion.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

bool all_enabled(const JointState& in) noexcept {
  return std::all_of(in.joints.begin(), in.joints.end(),
                     [](const EstimatedJoint& j) { return j.drive_enabled; });
}

bool all_settled(const JointState& in) noexcept {
  return std::none_of(in.joints.begin(), in.joints.end(),
                      [](const EstimatedJoint& j) { return j.status == JointStatus::kStarting; });
}

bool any_fault(const JointState& in) noexcept {
  return std::any_of(in.joints.begin(), in.joints.end(),
                     [](const EstimatedJoint& j) { return j.status == JointStatus::kFault; });
}

bool any_contact(const JointState& in) noexcept {
  return std::any_of(in.legs.begin(), in.legs.end(), [](const EstimatedLeg& l) { return l.contact; });
}

bool finite(const Vec3& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

Vec3 under_hip(double length_m) noexcept { return {0.0, 0.0, -length_m}; }

bool is_loss(MotionEvent event) noexcept {
  return event == MotionEvent::kSafetyLost || event == MotionEvent::kDriveLost ||
         event == MotionEvent::kFootLost;
}

bool on_curve(MotionPhase phase) noexcept {
  return phase == MotionPhase::kThrust || phase == MotionPhase::kFlight || phase == MotionPhase::kLanding;
}

}  // namespace

Motion::Motion(const RobotConfig& robot, const PresetConfig& preset)
    : preset_(preset),
      curve_(preset),
      joints_(robot),
      moves_(robot.legs.size()),
      departure_m_(robot.legs.size()) {}

const char* Motion::last_transition() const noexcept {
  return machine_.last() != nullptr ? machine_.last()->reason : "";
}

bool Motion::stand(const JointState& in) noexcept {
  stop_ = false;
  return process(MotionEvent::kStandRequested, in);
}

bool Motion::jump(const JointState& in, const JumpRequest& request) noexcept {
  if (state() != MotionPhase::kStanding) return false;
  stop_ = false;
  request_ = request;
  jumps_done_ = 0;
  jumps_left_ = request.count;
  jump_failure_ = nullptr;
  curve_.scale(request.scale);
  return process(MotionEvent::kJumpRequested, in);
}

bool Motion::sit(const JointState& in) noexcept { return process(MotionEvent::kSitRequested, in); }

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
  joints_.brake(now_us_);
}

void Motion::restart(const JointState& in) noexcept {
  process(MotionEvent::kRestarted, in);
  lost_ = false;
  phase_began_us_ = move_began_us_ = thrust_began_us_ = now_us_ =
      in.stamp.utime_us;  // the old times mean nothing now
}

bool Motion::process(MotionEvent event, const JointState& in) noexcept {
  now_us_ = in.stamp.utime_us;
  note_departure(in);
  const MotionPhase from = state();
  if (machine_.process_event(event) == nullptr) return false;
  phase_began_us_ = now_us_;
  lost_ = is_loss(event);
  enter(from, in);
  return true;
}

/// Where the next move begins: under compliance the leg is where its load has put it, and going on from the
/// desired foot would be a step; else where the path is now.
void Motion::note_departure(const JointState& in) noexcept {
  const bool measured = state() != MotionPhase::kIdle && compliant(progress(), preset_);
  for (std::size_t i = 0; i < departure_m_.size(); ++i) {
    const Vec3& foot = in.legs[i].estimated_foot_in_hip_m;
    departure_m_[i] = measured && finite(foot) ? foot : path(i).position_m;
  }
}

void Motion::enter(MotionPhase from, const JointState& in) noexcept {
  switch (state()) {
    case MotionPhase::kIdle:
      jumps_left_ = 0;
      break;
    case MotionPhase::kRising:
      enabled_ = false;
      break;
    case MotionPhase::kMovingJoint:
      enabled_ = enabled_ && from == MotionPhase::kMovingJoint;
      break;
    case MotionPhase::kCrouch:
      move_all(curve_.crouch_length_m(), preset_.crouch_time_s);
      break;
    case MotionPhase::kThrust:
      thrust_began_us_ = now_us_;
      contact_seen_ = any_contact(in);
      longest_m_ = 0.0;
      break;
    case MotionPhase::kRecover:
      if (from == MotionPhase::kLanding) {
        ++jumps_done_;
        --jumps_left_;
      }
      move_all(preset_.stand_length_m, preset_.recover_time_s);
      break;
    case MotionPhase::kSitting:
      let_go_ = from == MotionPhase::kMovingJoint;
      move_all(preset_.sit_length_m, preset_.rise_time_s);
      break;
    case MotionPhase::kStanding:
    case MotionPhase::kFlight:
    case MotionPhase::kLanding:
    case MotionPhase::kComplying:
      break;
  }
}

void Motion::move_all(double length_m, double duration_s) noexcept {
  for (std::size_t i = 0; i < moves_.size(); ++i)
    moves_[i] = {departure_m_[i], under_hip(length_m), duration_s};
  move_began_us_ = now_us_;
}

void Motion::update(const JointState& in) noexcept {
  now_us_ = in.stamp.utime_us;
  if (state() == MotionPhase::kIdle || lost(in)) return;
  switch (state()) {
    case MotionPhase::kRising:
      update_rising(in);
      break;
    case MotionPhase::kCrouch:
      update_crouch(in);
      break;
    case MotionPhase::kThrust:
      update_thrust(in);
      break;
    case MotionPhase::kFlight:
      update_flight(in);
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
    case MotionPhase::kIdle:
    case MotionPhase::kStanding:
    case MotionPhase::kComplying:
      break;
  }
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
  if (since(move_began_us_) >= preset_.rise_time_s) process(MotionEvent::kRisen, in);
}

void Motion::update_crouch(const JointState& in) noexcept {
  if (stop_) {
    process(MotionEvent::kStopped, in);
  } else if (in_phase_s() >= preset_.crouch_time_s + preset_.settle_time_s) {
    process(MotionEvent::kCrouched, in);
  }
}

void Motion::update_thrust(const JointState& in) noexcept {
  const bool contact = any_contact(in);
  contact_seen_ = contact_seen_ || contact;
  if (contact_seen_ && !contact) {
    process(MotionEvent::kLiftOff, in);
  } else if (drawn_in_again(in)) {
    process(MotionEvent::kRetracting, in);
  } else if (in_phase_s() >= preset_.thrust_timeout_s && process(MotionEvent::kThrustTimeout, in)) {
    jump_failure_ = last_transition();
  }
}

/// Measured, and sure where the force estimate is not: in a thrust the rotors' inertia hides the ground force (errata E6), but
/// a leg that is shorter again than it was cannot push any more.
bool Motion::drawn_in_again(const JointState& in) noexcept {
  double length_m = 0.0;
  for (const EstimatedLeg& leg : in.legs) length_m = std::max(length_m, -leg.estimated_foot_in_hip_m[2]);
  longest_m_ = std::max(longest_m_, length_m);
  const bool extended =
      longest_m_ > curve_.crouch_length_m() + kExtended * (curve_.longest_m() - curve_.crouch_length_m());
  return extended && length_m < longest_m_ - kDrawnIn_m;
}

void Motion::update_flight(const JointState& in) noexcept {
  const bool settled = since(thrust_began_us_) >= curve_.duration_s() + kTouchdownGuard_s;
  if (settled && any_contact(in)) {
    process(MotionEvent::kTouchdown, in);
  } else if (in_phase_s() >= preset_.flight_timeout_s && process(MotionEvent::kFlightTimeout, in)) {
    jump_failure_ = last_transition();
  }
}

void Motion::update_recover(const JointState& in) noexcept {
  if (in_phase_s() < preset_.recover_time_s + preset_.settle_time_s) return;
  const bool again = jumps_left_ > 0 && !stop_ && jump_failure_ == nullptr;
  if (jumps_left_ > 0 && stop_) jump_failure_ = "stopped by the operator before its last jump";
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

JumpProgress Motion::progress() const noexcept {
  return {state(), request_.mode, in_phase_s(), since(thrust_began_us_)};
}

FootPoint Motion::path(std::size_t leg) const noexcept {
  return on_curve(state()) ? curve_.at(since(thrust_began_us_)) : moves_[leg].at(since(move_began_us_));
}

}  // namespace sprung
