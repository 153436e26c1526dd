#pragma once
/// A gamepad of this machine (/dev/input/event*), or a file of what one said once (`cat /dev/input/event7 >
/// FILE`), which is played in its own time.
#include <cstdint>
#include <string>

#include "tools/station/server/gamepad.h"

namespace sprung::station {

class GamepadDevice {
 public:
  /// @throws std::runtime_error where it cannot be opened or is no gamepad, saying what to do.
  explicit GamepadDevice(const std::string& path);
  ~GamepadDevice();
  GamepadDevice(const GamepadDevice&) = delete;
  GamepadDevice& operator=(const GamepadDevice&) = delete;

  /// Takes what has come by now. @param now_us of any clock that goes forward.
  /// @return false when it is gone: pulled out, or the file is at its end.
  bool read(Gamepad& gamepad, std::int64_t now_us);
  const std::string& name() const noexcept { return name_; }

 private:
  void prepare(Gamepad& gamepad) const;  ///< ranges, and where sticks and buttons are now
  bool read_device(Gamepad& gamepad);
  bool read_recorded(Gamepad& gamepad, std::int64_t now_us);

  int fd_ = -1;
  bool recorded_ = false;
  bool prepared_ = false;
  std::string name_;
  std::int64_t offset_us_ = 0;  ///< from the file's times to ours
  bool has_next_ = false;
  std::int64_t next_us_ = 0;
  GamepadEvent next_;
};

}  // namespace sprung::station
