#pragma once
/// CAN frames in a target's input: 12 bytes each.
#include "drivers/can/can_frame.h"
#include "tests/fuzz/fuzz_input.h"

namespace sprung::fuzz {

/// Any that a back end of CanBus may hand over.
inline CanFrame frame_of(Input& input) {
  CanFrame frame;
  frame.id = input.number<std::uint16_t>() & 0x7FFU;
  frame.length = static_cast<std::uint8_t>(input.byte() % 9);
  const std::uint8_t flags = input.byte();
  frame.error = (flags & 1U) != 0;
  frame.remote = (flags & 2U) != 0;
  for (std::uint8_t& byte : frame.data) byte = input.byte();
  return frame;
}

inline std::string frame_bytes(const CanFrame& frame) {
  Output out;
  out.number(static_cast<std::uint16_t>(frame.id)).byte(frame.length);
  out.byte((frame.error ? 1 : 0) + (frame.remote ? 2 : 0));
  for (const std::uint8_t byte : frame.data) out.byte(byte);
  return out.bytes();
}

}  // namespace sprung::fuzz
