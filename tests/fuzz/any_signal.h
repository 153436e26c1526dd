#pragma once
/// A signal that came over the network: a good one with any of its bytes changed, which its decoder still
/// takes.
#include <array>
#include <limits>
#include <vector>

#include "runtime/message_layout.h"
#include "signals/messages.h"
#include "tests/fuzz/fuzz_input.h"

namespace sprung::fuzz {

inline constexpr int kMostPatches = 8;
inline constexpr std::size_t kStampOffset = kSessionOffset + 8;  ///< utime and seq

/// What breaks arithmetic, and what is just beyond a limit.
inline double special(std::uint8_t which) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array<double, 16> kValues{Limits::quiet_NaN(),
                                           Limits::infinity(),
                                           -Limits::infinity(),
                                           Limits::max(),
                                           -Limits::max(),
                                           Limits::denorm_min(),
                                           0.0,
                                           -0.0,
                                           1.0,
                                           -1.0,
                                           1e-3,
                                           0.1,
                                           10.0,
                                           1e3,
                                           1e9,
                                           1e19};
  return kValues[which % kValues.size()];
}

inline void put_big_endian(double value, std::uint8_t* bytes) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
}

/// Each patch: where, and which special double (below 16), which byte (below 32), or any 8 bytes.
inline void patch(Input& input, std::uint8_t* bytes, std::size_t size) {
  const std::size_t at = input.number<std::uint16_t>() % size;
  const std::uint8_t kind = input.byte();
  std::array<std::uint8_t, 8> with{};
  std::size_t count = with.size();
  if (kind < 16) {
    put_big_endian(special(kind), with.data());
  } else if (kind < 32) {
    with[0] = input.byte();
    count = 1;
  } else {
    const std::string_view raw = input.text(with.size());
    std::copy(raw.begin(), raw.end(), with.begin());
  }
  std::copy_n(with.begin(), std::min(count, size - at), bytes + at);
}

/// @return false where from_message refuses what came of it; the signal is unspecified then.
template <class Signal>
bool change(Input& input, Signal& signal) {
  MessageOf<Signal> message{};
  to_message(signal, 0, message);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  // Hash, session and counts stay: the receive guard has held them against the robot.
  static const MessageLayout layout = layout_of<MessageOf<Signal>>();
  const std::size_t counts = kCountsOffset + 4 * static_cast<std::size_t>(layout.counts);
  const int patches = input.byte() % (kMostPatches + 1);
  for (int i = 0; i < patches; ++i) {
    if (input.byte() % 8 == 1) {
      patch(input, bytes.data() + kStampOffset, kCountsOffset - kStampOffset);
    } else {
      patch(input, bytes.data() + counts, bytes.size() - counts);
    }
  }
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return from_message(message, signal).good;
}

}  // namespace sprung::fuzz
