#pragma once
/// How long frames occupy a bus (classic CAN, 11-bit identifiers; facts canopen 6.1), 3 bits of intermission
/// included. Pure.
namespace sprung::canopen {

/// Most bits that a frame of `data_bytes` 0..8 can take: 55 + 10 n, every possible stuff bit there.
constexpr int worst_frame_bits(int data_bytes) noexcept { return 55 + 10 * data_bytes; }

/// Share of a bus's time, 1.0 = full. @param bitrate bit/s, > 0.
constexpr double load(double bits_per_second, double bitrate) noexcept { return bits_per_second / bitrate; }

}  // namespace sprung::canopen
