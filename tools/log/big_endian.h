#pragma once
/// Numbers as LCM writes them. Pure; the caller has checked that the bytes are there.
#include <cstdint>

namespace sprung::log {

template <class Unsigned>
Unsigned get_big_endian(const std::uint8_t* bytes) noexcept {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) value = static_cast<Unsigned>(value << 8) | bytes[i];
  return value;
}

template <class Unsigned>
void put_big_endian(Unsigned value, std::uint8_t* bytes) noexcept {
  for (std::size_t i = sizeof(Unsigned); i-- > 0; value = static_cast<Unsigned>(value >> 8))
    bytes[i] = static_cast<std::uint8_t>(value & 0xFF);
}

}  // namespace sprung::log
