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

CanFdFrame fd_from_kernel(const canfd_frame& raw) noexcept {
  CanFdFrame frame;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.fast = (raw.flags & CANFD_BRS) != 0;
  frame.passive = (raw.flags & CANFD_ESI) != 0;
  frame.length = std::min<std::uint8_t>(raw.len, CANFD_MAX_DLEN);
  std::copy_n(raw.data, frame.length, frame.data.begin());
  return frame;
}

canfd_frame fd_to_kernel(const CanFdFrame& frame) noexcept {
  canfd_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
  raw.len = std::min<std::uint8_t>(frame.length, CANFD_MAX_DLEN);
  raw.flags = static_cast<std::uint8_t>((frame.fast ? CANFD_BRS : 0) | (frame.passive ? CANFD_ESI : 0));
  std::copy_n(frame.data.begin(), raw.len, raw.data);
  return raw;
}

}  // namespace sprung
