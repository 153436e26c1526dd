#pragma once
/// A message whose every field differs from its default, and its bytes, for tests that compare bit for bit.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "signals/message_mac.h"

namespace sprung::test {

template <class M>
std::vector<std::uint8_t> encoded(const M& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return bytes;
}

/// Random content behind hash and counts: every byte 0 or 1, so that enumerations and booleans stay valid.
/// @param prototype has its counts and its vectors' sizes set. @param counts number of leading counts.
template <class M>
M random_message(const M& prototype, std::size_t counts, unsigned seed) {
  std::vector<std::uint8_t> bytes = encoded(prototype);
  std::mt19937 random(seed);
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    const bool is_count = i >= 32 && i < 32 + 4 * counts;
    if (!is_count) bytes[i] = static_cast<std::uint8_t>(random() & 1U);
  }
  M message = prototype;
  EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  clear_mac(message);  // a signal has none
  return message;
}

}  // namespace sprung::test
