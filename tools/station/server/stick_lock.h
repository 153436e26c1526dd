#pragma once
/// Whether a gamepad's sticks, or keys, may move a robot: locked until they were seen at rest, a motion only
/// while the dead-man is held, locked again when nothing comes from them any more. Pure; times are the
/// session's us.
#include <array>
#include <cstdint>

#include "signals/enumeration.h"

namespace sprung::station {

/// Each from -1 to 1: share of the fastest that the gait goes.
struct StickValues {
  double forward = 0.0;
  double left = 0.0;
  double turning = 0.0;  ///< counter-clockwise, seen from above
};

struct StickInput {
  StickValues sticks;
  bool dead_man = false;  ///< the button that must be held
};

enum class StickState : std::uint8_t {
  kLocked,   ///< not seen at rest yet, or stale
  kReady,    ///< at rest, or the dead-man is not held
  kDriving,  ///< the robot is to go
};
constexpr auto words_of(StickState) {
  using E = StickState;
  return words<E>({{E::kLocked, "locked"}, {E::kReady, "ready"}, {E::kDriving, "driving"}});
}

class StickLock {
 public:
  static constexpr double kDeadZone = 0.12;           ///< [design choice] a worn stick rests within it
  static constexpr std::int64_t kStale_us = 500'000;  ///< [design choice] as long as the planner's hold

  /// Nothing but finite values within -1 to 1 is believed: another one locks.
  void input(const StickInput& input, std::int64_t now_us) noexcept;
  /// Another device, another page, or the window has lost the keyboard.
  void lock(const char* why) noexcept;
  /// What holds now; locks what has become stale.
  StickState state(std::int64_t now_us) noexcept;
  /// Beyond the dead zone, which begins at 0; all 0 unless driving.
  StickValues values() const noexcept;
  const char* why_locked() const noexcept { return why_locked_; }  ///< static text; "" where it is not

 private:
  StickState state_ = StickState::kLocked;
  StickInput last_;
  std::int64_t heard_us_ = 0;
  const char* why_locked_ = "let go of sticks and dead-man first";
};

}  // namespace sprung::station
