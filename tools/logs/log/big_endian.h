#pragma once
/// Numbers as LCM writes them. Pure; the caller has checked that the bytes are there.
#include <endian.h>

#include <cstdint>
#include <cstring>

namespace sprung::log {

template <class Unsigned>
Unsigned get_big_endian(const std::uint8_t* bytes) noexcept {
  Unsigned value;
  std::memcpy(&value, bytes, sizeof value);  // one instruction, not one for each byte
  if constexpr (sizeof value == 8) {
    return be64toh(value);
  } else if constexpr (sizeof value == 4) {
    return be32toh(value);
  } else {
    static_assert(sizeof value == 2);
    return be16toh(value);
  }
}

template <class Unsigned>
void put_big_endian(Unsigned value, std::uint8_t* bytes) noexcept {
  for (std::size_t i = sizeof(Unsigned); i-- > 0; value = static_cast<Unsigned>(value >> 8))
    bytes[i] = static_cast<std::uint8_t>(value & 0xFF);
}

}  // namespace sprung::log
