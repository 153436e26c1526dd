#pragma once
/// A CAN FD frame of somebody else: looked at, counted, never taken for one of ours.
#include <array>
#include <cstdint>

namespace sprung {

struct CanFdFrame {
  std::uint32_t id = 0;     ///< 11 bits, or 29 where `extended`
  bool extended = false;    ///< identifier of 29 bits
  bool fast = false;        ///< its data came at the higher bit rate (BRS)
  bool passive = false;     ///< its sender is error passive (ESI)
  std::uint8_t length = 0;  ///< 0..8, 12, 16, 20, 24, 32, 48 or 64
  std::array<std::uint8_t, 64> data{};
};

}  // namespace sprung
