#pragma once
/// Whether a drive shows the mode that it was told. Pure; stepped by time.
#include <cstdint>

#include "signals/modes.h"

namespace sprung {

class ModeWatch {
 public:
  /// Of the drive's own accord, by process data.
  void take_display(std::int8_t display) noexcept {
    display_ = display;
    told_ = true;
  }
  /// As it was read.
  void read_display(std::int8_t display) noexcept { display_ = display; }
  /// @param booted_with what was read while booting: good until the drive tells.
  void begin_operation(std::int8_t booted_with, std::int64_t time_us) noexcept;
  void restart() noexcept;
  /// A set-point with this mode goes out. @param confirmed the drive shows it, or need not.
  void send(DriveMode mode, bool confirmed, std::int64_t time_us) noexcept;

  std::int8_t display() const noexcept { return display_; }  ///< object 0x6061
  DriveMode sent() const noexcept { return sent_; }
  /// How long the drive has not shown the mode that it was told.
  std::int64_t unconfirmed_us() const noexcept { return unconfirmed_us_; }

 private:
  std::int8_t display_ = 0;
  bool told_ = false;  ///< by the drive, since the last restart()
  DriveMode sent_ = DriveMode::kTorque;
  std::int64_t confirmed_at_us_ = 0;
  std::int64_t unconfirmed_us_ = 0;
};

}  // namespace sprung
