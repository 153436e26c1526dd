#pragma once
/// EMCY messages, the error register 0x1001 and the error history 0x1003 (CiA 301, facts canopen 1.3 and
/// 2.5). Pure values.
#include <array>
#include <cstdint>

#include "drivers/canopen/wire.h"

namespace sprung::canopen {

/// Code 0 means that the last error is gone.
struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;      ///< copy of 0x1001
  std::array<std::uint8_t, 5> maker{};  ///< the maker's own bytes; 0 on an EPOS2 [U]
};
CanFrame emergency_frame(int node, const Emergency& emergency) noexcept;
/// @return false on a frame that has not 8 bytes of data.
bool decode_emergency(const CanFrame& frame, Emergency& emergency) noexcept;
/// What a code means: EPOS2's own (facts canopen 2.5), else its CiA 301 class ("temperature"). Static
/// text.
const char* emergency_text(std::uint16_t code) noexcept;

// Bits of the error register.
inline constexpr std::uint8_t kErrorGeneric = 0x01;
inline constexpr std::uint8_t kErrorCurrent = 0x02;
inline constexpr std::uint8_t kErrorVoltage = 0x04;
inline constexpr std::uint8_t kErrorTemperature = 0x08;
inline constexpr std::uint8_t kErrorCommunication = 0x10;
inline constexpr std::uint8_t kErrorProfile = 0x20;
inline constexpr std::uint8_t kErrorMaker = 0x80;  ///< EPOS calls it motion

/// Names of all bits set, e.g. "generic, communication"; "none" for 0. Ends with 0.
using ErrorRegisterText = std::array<char, 96>;
ErrorRegisterText error_register_text(std::uint8_t error_register) noexcept;

/// Entry of the error history (0x1003:01..): code below, the maker's word above.
constexpr std::uint32_t encode_history_entry(std::uint16_t code, std::uint16_t maker = 0) noexcept {
  return (static_cast<std::uint32_t>(maker) << 16) | code;
}
constexpr std::uint16_t history_code(std::uint32_t entry) noexcept {
  return static_cast<std::uint16_t>(entry & 0xFFFF);
}

}  // namespace sprung::canopen
