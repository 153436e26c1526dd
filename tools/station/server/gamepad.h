#pragma once
/// A gamepad's events, as Linux hands them out (linux/input.h, Documentation/input/gamepad.rst), and what
/// they say. Left stick: forward and sideways; right stick: turning; a shoulder button is the dead-man; the
/// button on the right (B, circle) stops at once. Pure.
#include <array>
#include <cstdint>

#include "tools/station/server/stick_lock.h"

namespace sprung::station {

/// struct input_event without its time.
struct GamepadEvent {
  std::uint16_t type = 0;
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

/// What an axis may say; as the device tells, or of most gamepads.
struct AxisRange {
  std::int32_t low = -32768;
  std::int32_t high = 32767;
};

class Gamepad {
 public:
  enum Axis : std::uint8_t { kForward, kLeft, kTurning };
  /// Codes of linux/input-event-codes.h: ABS_Y, ABS_X, ABS_RX.
  static constexpr std::array<std::uint16_t, 3> kAxisCodes{0x01, 0x00, 0x03};
  static constexpr std::array<std::uint16_t, 2> kDeadManCodes{0x136, 0x137};  ///< BTN_TL, BTN_TR
  static constexpr std::uint16_t kStopCode = 0x131;                           ///< BTN_EAST

  void set_range(Axis axis, AxisRange range) noexcept;
  void take(const GamepadEvent& event) noexcept;
  /// Events were lost (SYN_DROPPED): nothing is known until all was read anew by take() and read_anew().
  bool lost_events() const noexcept { return lost_; }
  void read_anew() noexcept { lost_ = false; }

  StickInput input() const noexcept;
  /// Since the last call the button that stops was pressed.
  bool take_stop() noexcept;

 private:
  std::array<AxisRange, 3> ranges_{};
  std::array<double, 3> axes_{};  ///< -1 to 1, positive as StickValues
  std::array<bool, 2> dead_man_{};
  bool stop_ = false;
  bool lost_ = false;
};

}  // namespace sprung::station
