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
  kLetGo,
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

constexpr auto words_of(MotionEvent) {
  using E = MotionEvent;
  return words<E>({{E::kStandRequested, "stand requested"},
                   {E::kEnableTimeout, "enable time-out"},
                   {E::kRisen, "risen"},
                   {E::kJumpRequested, "jump requested"},
                   {E::kCrouched, "crouched"},
                   {E::kStopped, "stopped"},
                   {E::kLiftOff, "lift-off"},
                   {E::kRetracting, "retracting"},
                   {E::kThrustTimeout, "thrust time-out"},
                   {E::kTouchdown, "touchdown"},
                   {E::kFlightTimeout, "flight time-out"},
                   {E::kLandingHeld, "landing held"},
                   {E::kRecovered, "recovered"},
                   {E::kNextJump, "next jump"},
                   {E::kSitRequested, "sit requested"},
                   {E::kLetGo, "let go"},
                   {E::kSat, "sat"},
                   {E::kJointRequested, "joint requested"},
                   {E::kJointArrived, "joint arrived"},
                   {E::kJointStopped, "joint stopped"},
                   {E::kComplyRequested, "comply requested"},
                   {E::kLandRequested, "land requested"},
                   {E::kWalkRequested, "walk requested"},
                   {E::kWalkEnded, "walk ended"},
                   {E::kFell, "fell"},
                   {E::kSafetyLost, "safety lost"},
                   {E::kDriveLost, "drive lost"},
                   {E::kFootLost, "foot lost"},
                   {E::kRestarted, "restarted"}});
}

struct MotionTransition {
  std::optional<MotionPhase> from;  ///< none: from any state but idle
  MotionEvent event;
  MotionPhase to;
  const char* reason;  ///< static text for people
};

using MotionTable = std::array<MotionTransition, 37>;
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
