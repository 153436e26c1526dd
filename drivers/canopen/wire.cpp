#include "drivers/canopen/wire.h"

namespace sprung::canopen {

void put_le(std::uint8_t* bytes, std::uint32_t value, int count) noexcept {
  for (int i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF);
}

std::uint32_t get_le(const std::uint8_t* bytes, int count) noexcept {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

CanFrame sync_frame() noexcept {
  CanFrame frame;
  frame.id = kSyncId;
  return frame;
}

}  // namespace sprung::canopen
