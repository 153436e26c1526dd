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

LegPhase leg_phase(MotionPhase phase) noexcept {
  switch (phase) {
    case MotionPhase::kIdle:
      return LegPhase::kIdle;
    case MotionPhase::kRising:
    case MotionPhase::kStanding:
    case MotionPhase::kSitting:
      return LegPhase::kStand;
    case MotionPhase::kCrouch:
      return LegPhase::kCrouch;
    case MotionPhase::kThrust:
      return LegPhase::kThrust;
    case MotionPhase::kFlight:
      return LegPhase::kFlight;
    case MotionPhase::kLanding:
      return LegPhase::kLanding;
    case MotionPhase::kRecover:
      return LegPhase::kRecover;
  }
  return LegPhase::kIdle;
}

bool is_loss(MotionEvent event) noexcept {
  return event == MotionEvent::kSafetyLost || event == MotionEvent::kDriveLost ||
         event == MotionEvent::kFootLost;
}

bool on_curve(MotionPhase phase) noexcept {
  return phase == MotionPhase::kThrust || phase == MotionPhase::kFlight || phase == MotionPhase::kLanding;
}

}  // namespace

Motion::Motion(const RobotConfig& robot, const PresetConfig& preset)
    : preset_(preset), curve_(preset), moves_(robot.legs.size()), departure_m_(robot.legs.size()) {}

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
      move_all(preset_.sit_length_m, preset_.rise_time_s);
      break;
    case MotionPhase::kStanding:
    case MotionPhase::kFlight:
    case MotionPhase::kLanding:
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
      if (in_phase_s() >= preset_.rise_time_s) process(MotionEvent::kSat, in);
      break;
    case MotionPhase::kIdle:
    case MotionPhase::kStanding:
      break;
  }
}

bool Motion::lost(const JointState& in) noexcept {
  if (in.safety != SafetyLevel::kOperational) return process(MotionEvent::kSafetyLost, in);
  const bool waiting = state() == MotionPhase::kRising && !enabled_;
  if (any_fault(in) || (!waiting && !all_enabled(in))) return process(MotionEvent::kDriveLost, in);
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

JumpProgress Motion::progress() const noexcept {
  return {state(), request_.mode, in_phase_s(), since(thrust_began_us_)};
}

FootPoint Motion::path(std::size_t leg) const noexcept {
  return on_curve(state()) ? curve_.at(since(thrust_began_us_)) : moves_[leg].at(since(move_began_us_));
}

void Motion::write(const JointState& in, LegCommand& out) const noexcept {
  out.stamp = in.stamp;
  out.used_joint_state_seq = in.stamp.seq;
  const bool waiting = state() == MotionPhase::kRising && !enabled_;
  for (std::size_t i = 0; i < out.legs.size(); ++i) {
    DesiredLeg& leg = out.legs[i];
    leg = DesiredLeg{};
    leg.phase = leg_phase(state());
    const FootPoint foot = waiting || state() == MotionPhase::kIdle
                               ? FootPoint{in.legs[i].estimated_foot_in_hip_m, {}, {}}
                               : path(i);
    leg.desired_foot_in_hip_m = foot.position_m;
    leg.desired_foot_velocity_m_s = foot.velocity_m_s;
    leg.desired_foot_acceleration_m_s2 = foot.acceleration_m_s2;
    if (state() != MotionPhase::kIdle) {
      set_control(progress(), preset_, leg);
    } else if (sinking()) {
      leg.control_mode = ControlMode::kDamping;
    }
  }
}

void Motion::write(MotionState& out) const noexcept {
  out.state = state();
  for (MotionLeg& leg : out.legs) leg = {leg_phase(state()), in_phase_s()};
  out.jumps_done = jumps_done_;
  out.jumps_left = jumps_left_;
  out.jump_height_scale = curve_.factor();
  out.jump_mode = request_.mode;
  out.last_transition = last_transition();
}

}  // namespace sprung
