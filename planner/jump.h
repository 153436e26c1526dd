#pragma once
/// A request to jump, from its first crouch to its last landing, or to catch a fall: what was asked, how far it is, and the
/// measured conditions that end thrust and flight. Pure.
#include <optional>

#include "planner/ballistics.h"
#include "planner/jump_curve.h"
#include "planner/leg_gains.h"
#include "planner/motion_state_machine.h"

namespace sprung {

/// Contact counts as touchdown only this long after the curve ended: until then the leg's own deceleration
/// can look like it.
inline constexpr double kTouchdownGuard_s = 0.05;

/// A thrust has ended when the leg, once extended by this share of its stroke, is shorter again by this length.
inline constexpr double kExtended = 0.5;
inline constexpr double kDrawnIn_m = 0.005;

/// In a fall the foot goes to its landing length first, in this time or, if less, in half the time that is left.
inline constexpr double kFallMove_s = 0.1;
/// Contact counts as touchdown only after this share of the fall, at most kTouchdownGuard_s after that move: moving the hanging
/// leg can look like it.
inline constexpr double kFallBlind = 0.75;

struct FallRequest {
  JumpMode mode = JumpMode::kHybrid;
  double touchdown_in_s = 0.0;  ///< > 0; falling from rest now
};

struct JumpRequest {
  JumpMode mode = JumpMode::kHybrid;
  int count = 1;
  double scale = 1.0;
};

class Jump {
 public:
  /// @throws std::invalid_argument on a jump curve that cannot be.
  explicit Jump(const PresetConfig& preset);

  void begin(const JumpRequest& request) noexcept;
  void begin(const FallRequest& request, std::int64_t now_us) noexcept;
  void begin_thrust(const JointState& in) noexcept;
  /// The event that this cycle's measurements are, or the time-out; none: it goes on.
  std::optional<MotionEvent> in_thrust(const JointState& in, double in_phase_s) noexcept;
  std::optional<MotionEvent> in_flight(const JointState& in, double in_phase_s) noexcept;
  void landed() noexcept;                                        ///< one jump (or fall) is done
  void abandon() noexcept { left_ = 0; }                         ///< no further ones
  void fail(const char* reason) noexcept { failure_ = reason; }  ///< static text
  void restart(std::int64_t now_us) noexcept { thrust_began_us_ = now_us; }

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

  double hybrid_switch_s_;
  double thrust_timeout_s_;
  double flight_timeout_s_;
  JumpCurve curve_;
  JumpRequest request_;
  bool falling_ = false;
  double fall_s_ = 0.0;               ///< from its beginning to the expected touchdown
  std::int64_t thrust_began_us_ = 0;  ///< or the fall
  LiftOff lift_off_;                  ///< fastest extension of the thrust
  ExpectedTouchdown expected_;
  bool contact_seen_ = false;  ///< since the thrust began
  double longest_m_ = 0.0;     ///< measured leg, since the thrust began
  int done_ = 0;
  int left_ = 0;
  const char* failure_ = nullptr;
};

}  // namespace sprung
