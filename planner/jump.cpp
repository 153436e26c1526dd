#include "planner/jump.h"

#include <algorithm>
#include <cmath>

#include "planner/measured.h"

namespace sprung {
namespace {

constexpr const char* kNoCurve = "this preset has no jump_curve: the robot does not jump";
constexpr double kMostAmplitude = 3.0;   // no curve is tried beyond
constexpr double kAmplitudeStep = 0.01;  // of the search for the highest that can be followed
constexpr double kPresetCurve = 1.0;     // amplitude of the preset's curve as it is
/// Learned: how much faster than the leg the hip may leave soft ground.
constexpr double kMostShareOfLimit = 2.0;
constexpr double kFarthestForward_m = 0.5;  // far beyond what a leg can

std::string millimetres(double length_m) { return std::to_string(std::lround(1e3 * length_m)); }

double seconds(std::int64_t from_us, std::int64_t to_us) noexcept {
  return 1e-6 * static_cast<double>(to_us - from_us);
}

}  // namespace

Jump::Jump(const RobotConfig& robot, const PresetConfig& preset)
    : hybrid_switch_s_(preset.hybrid_switch_s),
      thrust_timeout_s_(preset.thrust_timeout_s),
      flight_timeout_s_(preset.flight_timeout_s),
      preset_height_m_(preset.jump_curve.height_m),
      drift_m_(preset.jump_curve.drift_m),
      reach_(robot),
      curve_(preset),
      most_amplitude_(preset.jumps() ? highest_amplitude(preset) : kPresetCurve),
      adaptation_(preset.adapt_height) {
  if (!preset.jumps()) return;
  JumpCurve beyond(preset);
  beyond.scale(most_amplitude_ + kAmplitudeStep);
  const char* const why = reach_.validate(beyond);
  height_limits_ = "jump height must be " + millimetres(height_share(kLeastAmplitude) * preset_height_m_) +
                   " to " + millimetres(height_share(most_amplitude_) * preset_height_m_) +
                   " mm, or 0 for the preset's own curve; beyond, " +
                   (why != nullptr ? why : "nothing is known");
}

/// Largest amplitude up to which every curve can be followed, at least the preset's own.
double Jump::highest_amplitude(const PresetConfig& preset) const {
  JumpCurve curve(preset);
  double highest = kPresetCurve;
  for (int k = 1; kPresetCurve + k * kAmplitudeStep <= kMostAmplitude; ++k) {
    curve.scale(kPresetCurve + k * kAmplitudeStep);
    if (reach_.validate(curve) != nullptr) break;
    highest = curve.factor();
  }
  return highest;
}

const char* Jump::validate(const JumpRequest& request) const noexcept {
  if (preset_height_m_ <= 0.0) return kNoCurve;
  const double share = request.height_m / preset_height_m_;
  const bool possible = request.height_m == 0.0 ||
                        (share >= height_share(kLeastAmplitude) && share <= height_share(most_amplitude_));
  if (!possible) return height_limits_.c_str();
  if (!(std::abs(request.forward_m) <= kFarthestForward_m)) return "distance forward must be -500 to 500 mm";
  JumpCurve curve = curve_;
  curve.scale(amplitude(request));
  curve.forward(request.forward_m + drift_m_, flight_s(request));
  return request.forward_m == 0.0 ? nullptr : reach_.validate(curve);
}

double Jump::amplitude(const JumpRequest& request) const noexcept {
  if (request.height_m == 0.0) return kPresetCurve;
  const double share = adaptation_.factor(request.mode) * request.height_m / preset_height_m_;
  return std::min(amplitude_for(share), most_amplitude_);
}

/// Up and down again to the same length.
double Jump::flight_s(const JumpRequest& request) const noexcept {
  const double height_m = request.height_m == 0.0 ? preset_height_m_ : request.height_m;
  return 2.0 * std::sqrt(2.0 * height_m / kGravity_m_s2);
}

void Jump::begin(const JumpRequest& request) noexcept {
  falling_ = false;
  request_ = request;
  done_ = 0;
  left_ = request.count;
  failure_ = nullptr;
  shape();
}

void Jump::shape() noexcept {
  curve_.scale(amplitude(request_));
  const double drift_m = request_.forward_m == 0.0 ? 0.0 : drift_m_;
  curve_.forward(request_.forward_m + drift_m, flight_s(request_));
}

void Jump::begin(const FallRequest& request, std::int64_t now_us) noexcept {
  request_ = {request.mode, 1, 0.0, 0.0};
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
  slowed_ = false;
  estimated_height_m_ = kNaN;
  fastest_ = {in.stamp.utime_us, longest_leg_m(in), 0.0};
}

void Jump::landed() noexcept {
  ++done_;
  --left_;
}

std::optional<MotionEvent> Jump::in_thrust(const JointState& in, double in_phase_s) noexcept {
  follow_extension(in);
  const bool contact = any_contact(in);
  contact_seen_ = contact_seen_ || contact;
  const bool lost = contact_seen_ && !contact && longest_m_ > extended_m(kPushed);
  if (lost || drawn_in_again(in)) {
    lift_off(in);
    return lost ? MotionEvent::kLiftOff : MotionEvent::kRetracting;
  }
  if (in_phase_s < thrust_timeout_s_) return std::nullopt;
  lift_off(in);
  return MotionEvent::kThrustTimeout;
}

double Jump::extended_m(double share) const noexcept {
  return curve_.crouch_length_m() + share * (curve_.longest_m() - curve_.crouch_length_m());
}

/// While the foot stands on firm ground the hip rises as fast as the leg extends.
void Jump::follow_extension(const JointState& in) noexcept {
  const double length_m = longest_leg_m(in);
  longest_m_ = std::max(longest_m_, length_m);
  double speed_m_s = 0.0;
  for (const EstimatedLeg& leg : in.legs)
    speed_m_s = std::max(speed_m_s, -leg.estimated_foot_velocity_m_s[2]);
  if (speed_m_s > fastest_.speed_m_s) fastest_ = {in.stamp.utime_us, length_m, speed_m_s};
  const bool extended = longest_m_ > extended_m(kPushed);
  if (slowed_ || !extended || speed_m_s > kSlowed * fastest_.speed_m_s) return;
  slowed_ = true;
  lift_off_ = {in.stamp.utime_us, length_m, fastest_.speed_m_s};
}

/// It is certain now; it was earlier where the leg had slowed down before.
void Jump::lift_off(const JointState& in) noexcept {
  if (!slowed_) lift_off_ = {in.stamp.utime_us, longest_leg_m(in), fastest_.speed_m_s};
  LiftOff hip = lift_off_;
  hip.speed_m_s *= speed_share_;
  expected_ = expected_touchdown(hip, curve_.end_length_m());
}

/// Measured, and sure where the force estimate is not: in a thrust the rotors' inertia hides the ground force
/// (errata E6), but a leg that is shorter again than it was cannot push any more.
bool Jump::drawn_in_again(const JointState& in) noexcept {
  return longest_m_ > extended_m(kExtended) && longest_leg_m(in) < longest_m_ - kDrawnIn_m;
}

std::optional<MotionEvent> Jump::in_flight(const JointState& in, double in_phase_s) noexcept {
  const double blind_s = falling_ ? std::min(kFallBlind * fall_s_, fall_move_s() + kTouchdownGuard_s)
                                  : curve_.duration_s() + kTouchdownGuard_s;
  if (since_thrust_s(in.stamp.utime_us) >= blind_s && any_contact(in)) {
    if (!falling_) touch_down(in);
    return MotionEvent::kTouchdown;
  }
  const double longest_s = flight_timeout_s_ + (falling_ ? fall_s_ : 0.0);
  if (in_phase_s >= longest_s) return MotionEvent::kFlightTimeout;
  return std::nullopt;
}

void Jump::touch_down(const JointState& in) noexcept {
  const double in_air_s = seconds(lift_off_.utime_us, in.stamp.utime_us);
  const double risen_m = rise_m(lift_off_.length_m, longest_leg_m(in), in_air_s);
  if (!(lift_off_.speed_m_s > 0.0)) return;
  const double share = std::sqrt(2.0 * kGravity_m_s2 * risen_m) / lift_off_.speed_m_s;
  estimated_height_m_ = rise_from_surface_m(risen_m, share);
  if (!adaptation_.learns()) return;
  adaptation_.learn(request_.mode, request_.height_m, estimated_height_m_);
  speed_share_ = std::clamp(share, 1.0 / kMostShareOfLimit, kMostShareOfLimit);
}

}  // namespace sprung
