#include "drivers/can/kernel_frame.h"

#include <algorithm>

namespace sprung {

can_frame to_kernel(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id | (frame.remote ? CAN_RTR_FLAG : 0U) | (frame.error ? CAN_ERR_FLAG : 0U);
  raw.can_dlc = frame.length;
  if (!frame.remote) std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

bool from_kernel(const can_frame& raw, CanFrame& frame) noexcept {
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  if (!frame.error && (raw.can_id & CAN_EFF_FLAG) != 0) return false;
  frame.remote = !frame.error && (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.id = raw.can_id & (frame.error ? CAN_ERR_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
  std::copy(raw.data, raw.data + 8, frame.data.begin());
  return true;
}

}  // namespace sprung
