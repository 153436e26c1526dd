#pragma once
/// An emergency stop is said at once and again every 20 ms until the drives' own state shows that none of
/// them has power: one lost datagram must not matter. Pure; times are the session's us.
#include <cstdint>

#include "signals/enumeration.h"

namespace sprung::station {

enum class EstopState : std::uint8_t {
  kNone,
  kPressed,    ///< said again and again: a drive has power, or nobody tells
  kConfirmed,  ///< no drive has had power since
};
constexpr auto words_of(EstopState) {
  using E = EstopState;
  return words<E>({{E::kNone, "none"}, {E::kPressed, "pressed"}, {E::kConfirmed, "confirmed"}});
}

class EstopRepeater {
 public:
  /// [design choice] 20 ms is promised; whoever waits wakes up late by a millisecond or two.
  static constexpr std::int64_t kAgain_us = 18'000;

  /// Pressed while it is pressed: nothing changes. @return whether this is a new press.
  bool press(std::int64_t now_us) noexcept;
  /// What a DRIVE_STATE says. One from before the press confirms nothing. @return whether it confirms.
  bool drives(bool may_have_torque, std::int64_t state_us) noexcept;
  /// Whether to say it now; at most every kAgain_us.
  bool due(std::int64_t now_us) noexcept;

  /// When due() is to be asked next; the end of time where nothing is pressed.
  std::int64_t next_us() const noexcept;

  EstopState state() const noexcept { return state_; }
  std::int64_t pressed_us() const noexcept { return pressed_us_; }
  /// By the time of the DRIVE_STATE that confirmed it.
  std::int64_t confirmed_us() const noexcept { return confirmed_us_; }

 private:
  EstopState state_ = EstopState::kNone;
  std::int64_t pressed_us_ = 0;
  std::int64_t confirmed_us_ = 0;
  std::int64_t due_us_ = 0;
};

}  // namespace sprung::station
