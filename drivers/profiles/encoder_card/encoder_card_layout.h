#pragma once
/// The 64 bits of an encoder card's sample (object 0x2100, sent whole as TPDO1), shared by the bridge's
/// profile and the simulated card: three 20-bit positions and a counter that goes up by one with each sample
/// (design section 2). Pure.
#include <array>
#include <cstddef>
#include <cstdint>

namespace sprung::encoder_card {

inline constexpr std::size_t kChannels = 3;
inline constexpr int kChannelBits = 20;
inline constexpr std::uint32_t kCountsPerTurn = 1U << kChannelBits;
inline constexpr std::uint32_t kCountMask = kCountsPerTurn - 1;
inline constexpr std::uint8_t kCounterMask = 0x0F;

struct Sample {
  std::array<std::uint32_t, kChannels> counts{};  ///< absolute within one turn, 0..2^20 - 1
  std::uint8_t counter = 0;                       ///< 0..15, then 0 again
};

/// Bits 0-19 channel 0, 20-39 channel 1, 40-59 channel 2, 60-63 counter; what does not fit is cut off.
constexpr std::uint64_t pack(const Sample& sample) noexcept {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kChannels; ++i)
    word |= static_cast<std::uint64_t>(sample.counts[i] & kCountMask) << (kChannelBits * static_cast<int>(i));
  return word | static_cast<std::uint64_t>(sample.counter & kCounterMask) << 60;
}

constexpr Sample unpack(std::uint64_t word) noexcept {
  Sample sample;
  for (std::size_t i = 0; i < kChannels; ++i)
    sample.counts[i] = static_cast<std::uint32_t>(word >> (kChannelBits * static_cast<int>(i))) & kCountMask;
  sample.counter = static_cast<std::uint8_t>(word >> 60);
  return sample;
}

/// Samples lost between two that arrived one after the other: 0 when none, 15 also for the same one twice.
constexpr int missed_samples(std::uint8_t last, std::uint8_t now) noexcept {
  return (now - last - 1) & kCounterMask;
}

}  // namespace sprung::encoder_card
