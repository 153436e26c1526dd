#pragma once
/// One CAN frame as a datagram of python-can's `udp_multicast` interface: a msgpack map of string keys (facts
/// canopen 7.1). Pure; never throws.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/can/can_frame.h"

namespace sprung {

/// A frame with the `timestamp` field of its datagram, which python-can sends as 0 and ignores on reception;
/// the lock-step link carries its sequence numbers in it (drivers/can/lockstep_burst.h).
struct StampedFrame {
  CanFrame frame;
  double timestamp = 0.0;
  /// Of a received one at the kernel, CLOCK_MONOTONIC; not part of the datagram.
  std::int64_t arrival_us = 0;
};

struct UdpDatagram {
  static constexpr std::size_t kCapacity = 256;  ///< largest classic frame is 164 bytes
  std::array<char, kCapacity> bytes{};
  std::size_t size = 0;
};

/// The same bytes in the same order as python-can.
void encode_datagram(const StampedFrame& frame, UdpDatagram& datagram) noexcept;

/// @return false when it is no msgpack map of the known keys, or no classic 11-bit frame. A frame
/// without the key is_extended_id is an extended one, as in python-can.
bool decode_datagram(const char* bytes, std::size_t size, StampedFrame& frame) noexcept;

}  // namespace sprung
