#include "planner/jump.h"

#include <algorithm>

#include "planner/measured.h"

namespace sprung {

Jump::Jump(const PresetConfig& preset)
    : hybrid_switch_s_(preset.hybrid_switch_s),
      thrust_timeout_s_(preset.thrust_timeout_s),
      flight_timeout_s_(preset.flight_timeout_s),
      curve_(preset) {}

void Jump::begin(const JumpRequest& request) noexcept {
  falling_ = false;
  request_ = request;
  done_ = 0;
  left_ = request.count;
  failure_ = nullptr;
  curve_.scale(request.scale);
}

void Jump::begin(const FallRequest& request, std::int64_t now_us) noexcept {
  request_ = {request.mode, 1, curve_.factor()};
  falling_ = true;
  fall_s_ = request.touchdown_in_s;
  done_ = 0;
  left_ = 1;
  failure_ = nullptr;
  thrust_began_us_ = now_us;
  expected_ = fall_from_rest(now_us, fall_s_);
}

double Jump::fall_move_s() const noexcept { return std::min(kFallMove_s, 0.5 * fall_s_); }

JumpProgress Jump::progress(MotionPhase phase, double in_phase_s, std::int64_t now_us) const noexcept {
  return {phase, request_.mode, in_phase_s, since_thrust_s(now_us),
          falling_ ? fall_move_s() : hybrid_switch_s_};
}

void Jump::begin_thrust(const JointState& in) noexcept {
  thrust_began_us_ = in.stamp.utime_us;
  contact_seen_ = any_contact(in);
  longest_m_ = 0.0;
  lift_off_ = {in.stamp.utime_us, longest_leg_m(in), 0.0};
  expected_ = expected_touchdown(lift_off_, curve_.end_length_m());
}

void Jump::landed() noexcept {
  ++done_;
  --left_;
}

std::optional<MotionEvent> Jump::in_thrust(const JointState& in, double in_phase_s) noexcept {
  follow_extension(in);
  const bool contact = any_contact(in);
  contact_seen_ = contact_seen_ || contact;
  if (contact_seen_ && !contact) return MotionEvent::kLiftOff;
  if (drawn_in_again(in)) return MotionEvent::kRetracting;
  if (in_phase_s >= thrust_timeout_s_) return MotionEvent::kThrustTimeout;
  return std::nullopt;
}

/// While the foot stands the hip rises as fast as the leg extends; in the air the leg can only slow down.
void Jump::follow_extension(const JointState& in) noexcept {
  for (const EstimatedLeg& leg : in.legs) {
    const double speed_m_s = -leg.estimated_foot_velocity_m_s[2];
    if (!(speed_m_s > lift_off_.speed_m_s)) continue;
    lift_off_ = {in.stamp.utime_us, -leg.estimated_foot_in_hip_m[2], speed_m_s};
    expected_ = expected_touchdown(lift_off_, curve_.end_length_m());
  }
}

/// Measured, and sure where the force estimate is not: in a thrust the rotors' inertia hides the ground force (errata E6), but
/// a leg that is shorter again than it was cannot push any more.
bool Jump::drawn_in_again(const JointState& in) noexcept {
  const double length_m = longest_leg_m(in);
  longest_m_ = std::max(longest_m_, length_m);
  const bool extended =
      longest_m_ > curve_.crouch_length_m() + kExtended * (curve_.longest_m() - curve_.crouch_length_m());
  return extended && length_m < longest_m_ - kDrawnIn_m;
}

std::optional<MotionEvent> Jump::in_flight(const JointState& in, double in_phase_s) noexcept {
  const double blind_s = falling_ ? std::min(kFallBlind * fall_s_, fall_move_s() + kTouchdownGuard_s)
                                  : curve_.duration_s() + kTouchdownGuard_s;
  if (since_thrust_s(in.stamp.utime_us) >= blind_s && any_contact(in)) return MotionEvent::kTouchdown;
  const double longest_s = flight_timeout_s_ + (falling_ ? fall_s_ : 0.0);
  if (in_phase_s >= longest_s) return MotionEvent::kFlightTimeout;
  return std::nullopt;
}

}  // namespace sprung
