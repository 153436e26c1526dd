#pragma once
/// A request to jump, from its first crouch to its last landing, or to catch a fall: what was asked, how far
/// it is, and the measured conditions that end thrust and flight. Pure.
#include <optional>
#include <string>

#include "planner/ballistics.h"
#include "planner/height_law.h"
#include "planner/jump_curve.h"
#include "planner/jump_reach.h"
#include "planner/leg_gains.h"
#include "planner/motion_state_machine.h"
#include "signals/joint_state.h"
#include "signals/vec3.h"

namespace sprung {

/// Contact counts as touchdown only this long after the curve ended: until then the leg's own deceleration
/// can look like it.
inline constexpr double kTouchdownGuard_s = 0.05;

/// A thrust has ended when the leg, once extended by this share of its stroke, is shorter again by this
/// length.
inline constexpr double kExtended = 0.5;
inline constexpr double kDrawnIn_m = 0.005;

/// In a fall the foot goes to its landing length first, in this time or, if less, in half the time that is
/// left.
inline constexpr double kFallMove_s = 0.1;
/// Contact counts as touchdown only after this share of the fall, at most kTouchdownGuard_s after that move:
/// moving the hanging leg can look like it.
inline constexpr double kFallBlind = 0.75;

struct FallRequest {
  JumpMode mode = JumpMode::kHybrid;
  double touchdown_in_s = 0.0;  ///< > 0; falling from rest now
};

/// Contact that is lost before the leg is extended by this share of its stroke is no lift-off: the sudden
/// start of a thrust can look like it.
inline constexpr double kPushed = 0.25;
/// The ground lets go of the foot about when the leg extends slower than this share of its fastest: measured
/// on ground of 5 to 60 kN/m, where lost contact is noticed up to 40 ms later (docs/control.md).
inline constexpr double kSlowed = 0.9;

struct JumpRequest {
  JumpMode mode = JumpMode::kHybrid;
  int count = 1;
  double height_m = 0.0;   ///< 0: the curve as it is in the preset
  double forward_m = 0.0;  ///< backward: negative
};

class Jump {
 public:
  /// @throws std::invalid_argument on a jump curve that cannot be.
  Jump(const RobotConfig& robot, const PresetConfig& preset);

  /// Why it cannot be done, with the limit, text that lives as long as this; nullptr: it can.
  const char* validate(const JumpRequest& request) const noexcept;
  void begin(const JumpRequest& request) noexcept;
  /// Before each thrust: the curve for what was asked, with what was learned.
  void shape() noexcept;
  void begin(const FallRequest& request, std::int64_t now_us) noexcept;
  void begin_thrust(const JointState& in) noexcept;
  /// The event that this cycle's measurements are, or the time-out; none: it goes on.
  std::optional<MotionEvent> in_thrust(const JointState& in, double in_phase_s) noexcept;
  std::optional<MotionEvent> in_flight(const JointState& in, double in_phase_s) noexcept;
  void landed() noexcept;                                        ///< one jump (or fall) is done
  void abandon() noexcept { left_ = 0; }                         ///< no further ones
  void fail(const char* reason) noexcept { failure_ = reason; }  ///< static text
  void restart(std::int64_t now_us) noexcept { thrust_began_us_ = now_us; }

  /// Rise of the hip in the last jump, from leg lengths and flight time; NaN where there was none.
  double estimated_height_m() const noexcept { return estimated_height_m_; }
  const JumpCurve& curve() const noexcept { return curve_; }
  FootPoint path(std::int64_t now_us) const noexcept { return curve_.at(since_thrust_s(now_us)); }
  double since_thrust_s(std::int64_t now_us) const noexcept {
    return 1e-6 * static_cast<double>(now_us - thrust_began_us_);
  }
  bool falling() const noexcept { return falling_; }
  /// In a fall: how long the foot moves to its landing length.
  double fall_move_s() const noexcept;
  /// From the cycle on in which flight began.
  const ExpectedTouchdown& expected() const noexcept { return expected_; }
  JumpProgress progress(MotionPhase phase, double in_phase_s, std::int64_t now_us) const noexcept;
  JumpMode mode() const noexcept { return request_.mode; }
  int done() const noexcept { return done_; }
  int left() const noexcept { return left_; }
  /// Why it was not as requested; nullptr when it was.
  const char* failure() const noexcept { return failure_; }

 private:
  bool drawn_in_again(const JointState& in) noexcept;
  void follow_extension(const JointState& in) noexcept;
  void lift_off(const JointState& in) noexcept;
  void touch_down(const JointState& in) noexcept;
  double extended_m(double share) const noexcept;
  double highest_amplitude(const PresetConfig& preset) const;
  double amplitude(const JumpRequest& request) const noexcept;
  double flight_s(const JumpRequest& request) const noexcept;

  double hybrid_switch_s_;
  double thrust_timeout_s_;
  double flight_timeout_s_;
  double preset_height_m_;  ///< of the preset's curve as it is
  double drift_m_;
  JumpReach reach_;
  JumpCurve curve_;
  double most_amplitude_;
  std::string height_limits_;
  HeightAdaptation adaptation_;
  JumpRequest request_;
  bool falling_ = false;
  double fall_s_ = 0.0;               ///< from its beginning to the expected touchdown
  std::int64_t thrust_began_us_ = 0;  ///< or the fall
  LiftOff fastest_;                   ///< extension of the thrust
  LiftOff lift_off_;                  ///< when the leg had slowed down, or contact was lost
  bool slowed_ = false;
  double speed_share_ = 1.0;  ///< hip's speed at lift-off over the leg's fastest, learned: soft ground throws
                              ///< it up
  double estimated_height_m_ = kNaN;
  ExpectedTouchdown expected_;
  bool contact_seen_ = false;  ///< since the thrust began
  double longest_m_ = 0.0;     ///< measured leg, since the thrust began
  int done_ = 0;
  int left_ = 0;
  const char* failure_ = nullptr;
};

}  // namespace sprung
