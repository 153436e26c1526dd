#pragma once
/// A frame that somebody saw on a bus: what every tool of this folder takes and gives.
#include <cstdint>

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

}  // namespace sprung::cantools
