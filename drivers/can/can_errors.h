#pragma once
/// SocketCAN error frames (CanFrame::error): class bits in `id`, details in `data` (linux/can/error.h, facts
/// canopen 5).
#include "drivers/can/can_frame.h"

namespace sprung {

inline constexpr std::uint32_t kCanErrorTxTimeout = 0x001;
inline constexpr std::uint32_t kCanErrorController = 0x004;  ///< details in data[1]
inline constexpr std::uint32_t kCanErrorBusOff = 0x040;
inline constexpr std::uint32_t kCanErrorRestarted = 0x100;
inline constexpr std::uint8_t kControllerPassive = 0x30;     ///< data[1]: receive or transmit error passive
inline constexpr std::uint8_t kControllerTxOverflow = 0x02;  ///< data[1]

/// sprung's own: SocketCAN has no error frame for a link that is down, but refuses to send (ENETDOWN). In
/// data[5], which belongs to the controller's maker and is 0 in a kernel's transmit time-out.
inline constexpr std::uint8_t kLinkDownMark = 0x4C;

/// Bus off.
inline CanFrame bus_lost_frame() noexcept {
  CanFrame frame;
  frame.id = kCanErrorBusOff;
  frame.length = 8;
  frame.error = true;
  return frame;
}

/// What a simulated bus tells when the interface's queue is full (ENOBUFS): bus off too, since set-points are
/// lost, but told apart.
inline CanFrame queue_full_frame() noexcept {
  CanFrame frame = bus_lost_frame();
  frame.id |= kCanErrorController;
  frame.data[1] = kControllerTxOverflow;
  return frame;
}

inline bool tells_queue_full(const CanFrame& frame) noexcept {
  return frame.error && (frame.id & kCanErrorController) != 0 && (frame.data[1] & kControllerTxOverflow) != 0;
}

/// What it tells when the link is down: a transmit time-out with sprung's mark.
inline CanFrame link_down_frame() noexcept {
  CanFrame frame = bus_lost_frame();
  frame.id = kCanErrorTxTimeout;
  frame.data[5] = kLinkDownMark;
  return frame;
}

inline bool tells_link_down(const CanFrame& frame) noexcept {
  return frame.error && frame.id == kCanErrorTxTimeout && frame.data[5] == kLinkDownMark;
}

/// Bus off, transmit time-out or error passive: nothing sent on this bus can be relied on.
inline bool tells_bus_lost(const CanFrame& frame) noexcept {
  if (!frame.error) return false;
  if ((frame.id & (kCanErrorBusOff | kCanErrorTxTimeout)) != 0) return true;
  return (frame.id & kCanErrorController) != 0 && (frame.data[1] & kControllerPassive) != 0;
}

/// The controller came back on the bus.
inline bool tells_bus_restarted(const CanFrame& frame) noexcept {
  return frame.error && (frame.id & kCanErrorRestarted) != 0;
}

}  // namespace sprung
