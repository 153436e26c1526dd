#pragma once
/// A frame that somebody saw on a bus: what every tool of this folder takes and gives.
#include <cstdint>

#include "drivers/can/can_fd_frame.h"
#include "drivers/can/can_frame.h"

namespace sprung::cantools {

/// As the bridge sees it, or whoever wrote the log.
enum class Direction : std::int8_t { kUnknown, kSent, kReceived };

struct ObservedFrame {
  std::int64_t time_us = 0;  ///< on the source's own clock
  int bus = 0;               ///< index into the source's bus names
  Direction direction = Direction::kUnknown;
  CanFrame frame;
};

/// A CAN FD frame: shown, and not decoded, since nothing of ours speaks it.
struct ObservedFdFrame {
  std::int64_t time_us = 0;  ///< on the source's own clock, when it was read
  int bus = 0;
  CanFdFrame frame;
};

}  // namespace sprung::cantools
