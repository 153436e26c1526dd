#pragma once
/// CRC-32 as MCAP, zip and Ethernet have it, by zlib. Pure.
#include <cstdint>
#include <string_view>

namespace sprung::log {

/// @param before of the bytes in front of these: pieces one after the other give what the whole gives.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0) noexcept;

}  // namespace sprung::log
