#pragma once
/// Datagrams of LCM's protocol, byte by byte, as nobody's LCM would send them.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung::test {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& bytes, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
inline void append(Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

inline Bytes short_datagram(std::uint32_t seq, const std::string& channel, const std::string& data) {
  Bytes bytes;
  append(bytes, "LC02");
  append(bytes, seq, 4);
  append(bytes, channel);
  bytes.push_back(0);
  append(bytes, data);
  return bytes;
}

struct FragmentHead {
  std::uint32_t seq = 1;
  std::uint32_t message_size = 6;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 2;
};

/// @param rest for number 0 begins with channel and zero.
inline Bytes fragment_datagram(const FragmentHead& head, const std::string& rest) {
  Bytes bytes;
  append(bytes, "LC03");
  append(bytes, head.seq, 4);
  append(bytes, head.message_size, 4);
  append(bytes, head.offset, 4);
  append(bytes, head.number, 2);
  append(bytes, head.count, 2);
  append(bytes, rest);
  return bytes;
}

/// "CH" and its zero, then data.
inline std::string with_channel(const std::string& data) { return std::string("CH\0", 3) + data; }

}  // namespace sprung::test
