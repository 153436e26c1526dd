#pragma once
/// What an Xsens MTi puts on its line, made by hand.
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace sprung::test {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const Bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

inline Bytes big_endian(std::uint64_t value, int count) {
  Bytes bytes;
  for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return bytes;
}

inline Bytes float32(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return big_endian(bits, 4);
}

inline Bytes packet(std::uint16_t id, const Bytes& data) {
  Bytes bytes = big_endian(id, 2);
  bytes.push_back(static_cast<std::uint8_t>(data.size()));
  append(bytes, data);
  return bytes;
}

inline Bytes floats(std::uint16_t id, const std::vector<float>& values) {
  Bytes data;
  for (const float value : values) append(data, float32(value));
  return packet(id, data);
}

inline Bytes xbus_message(std::uint8_t id, const Bytes& data) {
  Bytes bytes{0xFA, 0xFF, id};
  if (data.size() >= 0xFF) {
    bytes.push_back(0xFF);
    append(bytes, big_endian(data.size(), 2));
  } else {
    bytes.push_back(static_cast<std::uint8_t>(data.size()));
  }
  append(bytes, data);
  const unsigned sum = std::accumulate(bytes.begin() + 1, bytes.end(), 0U);
  bytes.push_back(static_cast<std::uint8_t>(0x100 - (sum & 0xFF)));
  return bytes;
}

/// A sample of all that sprung-imu-driver reads.
struct XbusSample {
  std::uint16_t counter = 0;
  std::vector<float> rate{0.1F, 0.2F, 0.3F};
  std::vector<float> force{0.0F, 0.0F, 9.81F};
  std::vector<float> quaternion{1.0F, 0.0F, 0.0F, 0.0F};
  std::uint16_t quaternion_id = 0x2010;
  std::uint32_t status = 0x3;  ///< self-test passed, filter valid

  Bytes data() const {
    Bytes bytes = packet(0x1020, big_endian(counter, 2));
    append(bytes, packet(0x1060, big_endian(20U * counter, 4)));
    if (!quaternion.empty()) append(bytes, floats(quaternion_id, quaternion));
    if (!rate.empty()) append(bytes, floats(0x8020, rate));
    if (!force.empty()) append(bytes, floats(0x4020, force));
    append(bytes, packet(0xE020, big_endian(status, 4)));
    return bytes;
  }
  Bytes bytes() const { return xbus_message(0x36, data()); }
};

}  // namespace sprung::test
