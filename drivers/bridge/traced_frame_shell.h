#pragma once
/// One CAN frame as CAN_TRACE tells it (lcmtypes/can_trace.lcm).
#include <cstdint>

#include "drivers/can/can_frame.h"
#include "sprung_msgs/traced_frame_t.hpp"

namespace sprung {

/// @param sent by the bridge; else received.
sprung_msgs::traced_frame_t traced_frame(int bus, const CanFrame& frame, bool sent, std::int64_t time_us);

}  // namespace sprung
