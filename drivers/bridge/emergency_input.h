#pragma once
/// The digital input of a drive at which an emergency stop is read: by the drive's frame that is sent on
/// change, and ten times a second by SDO, should that one be lost. Until it is known no drive gets power; a
/// cut wire stops where the input stops at 0. Pure.
#include <cstdint>

#include "robots/robot_config.h"

namespace sprung {

class EmergencyInput {
 public:
  explicit EmergencyInput(const EmergencyInputConfig& config) noexcept : config_(config) {}

  bool exists() const noexcept { return config_.bit >= 0; }
  void take(std::uint32_t levels) noexcept {
    known_ = true;
    stops_ = (((levels >> config_.bit) & 1U) != 0) == config_.stops_high;
  }
  /// The drive has restarted.
  void forget() noexcept { known_ = stops_ = false; }
  bool known() const noexcept { return !exists() || known_; }
  bool stops() const noexcept { return exists() && known_ && stops_; }

 private:
  EmergencyInputConfig config_;
  bool known_ = false;
  bool stops_ = false;
};

}  // namespace sprung
