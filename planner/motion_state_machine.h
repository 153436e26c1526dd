#pragma once
/// States of the robot's motion, the events that move it between them, and why: one table, which runs, is
/// tested row by row and is what `sprung transitions` prints. Pure.
#include <array>
#include <optional>

#include "signals/modes.h"

namespace sprung {

enum class MotionEvent : std::int8_t {
  kStandRequested,
  kEnableTimeout,
  kRisen,
  kJumpRequested,
  kCrouched,
  kStopped,
  kLiftOff,
  kRetracting,
  kThrustTimeout,
  kTouchdown,
  kFlightTimeout,
  kLandingHeld,
  kRecovered,
  kNextJump,
  kSitRequested,
  kSat,
  kJointRequested,
  kJointArrived,
  kJointStopped,
  kComplyRequested,
  kLandRequested,
  kWalkRequested,
  kWalkEnded,
  kFell,
  kSafetyLost,
  kDriveLost,
  kFootLost,
  kRestarted,
};

const char* name(MotionEvent value) noexcept;

struct MotionTransition {
  std::optional<MotionPhase> from;  ///< none: from any state but idle
  MotionEvent event;
  MotionPhase to;
  const char* reason;  ///< static text for people
};

using MotionTable = std::array<MotionTransition, 36>;
const MotionTable& motion_transitions() noexcept;

class MotionStateMachine {
 public:
  MotionPhase state() const noexcept { return state_; }
  /// The last transition taken; nullptr before the first.
  const MotionTransition* last() const noexcept { return last_; }
  /// @return the transition taken, or nullptr when this state has none for the event: then nothing changes.
  const MotionTransition* process_event(MotionEvent event) noexcept;

 private:
  MotionPhase state_ = MotionPhase::kIdle;
  const MotionTransition* last_ = nullptr;
};

}  // namespace sprung
