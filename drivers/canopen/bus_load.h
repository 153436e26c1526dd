#pragma once
/// How long frames occupy a bus (classic CAN, 11-bit identifiers; facts canopen 6.1), 3 bits of intermission
/// included. Pure.
#include <cstdint>

#include "drivers/can/can_frame.h"

namespace sprung::canopen {

/// Most bits that a frame of `data_bytes` 0..8 can take: 55 + 10 n, every possible stuff bit there.
constexpr int worst_frame_bits(int data_bytes) noexcept { return 55 + 10 * data_bytes; }
/// Fewest: 47 + 8 n, no stuff bit.
constexpr int bare_frame_bits(int data_bytes) noexcept { return 47 + 8 * data_bytes; }

/// Bits of this very frame, with its CRC-15 and its stuff bits; remote frames too. Not for error frames,
/// which are no frames on the wire.
int exact_frame_bits(const CanFrame& frame) noexcept;

/// CRC-15 (polynomial 0x4599) as in the frame, over its bits before stuffing.
std::uint16_t frame_crc(const CanFrame& frame) noexcept;

/// Share of a bus's time, 1.0 = full. @param bitrate bit/s, > 0.
constexpr double load(double bits_per_second, double bitrate) noexcept { return bits_per_second / bitrate; }

}  // namespace sprung::canopen
