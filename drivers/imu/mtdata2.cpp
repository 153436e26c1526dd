#include "drivers/imu/mtdata2.h"

#include <cstring>

namespace sprung::imu {
namespace {

constexpr std::uint16_t kFormatMask = 0x0003;
constexpr std::uint16_t kAxesMask = 0x000C;
constexpr std::uint16_t kAxesDown = 0x0004;
constexpr std::uint16_t kCounter = 0x1020, kTime = 0x1060, kQuaternion = 0x2010, kForce = 0x4020,
                        kRate = 0x8020, kStatus = 0xE020;

std::uint64_t big_endian(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

template <class To, class From>
To same_bits(From from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

constexpr std::size_t kNumberBytes[] = {4, 4, 6, 8};

double number(const std::uint8_t* bytes, std::uint16_t format) noexcept {
  switch (format) {
    case 0:
      return same_bits<float>(static_cast<std::uint32_t>(big_endian(bytes, 4)));
    case 1:
      return same_bits<std::int32_t>(static_cast<std::uint32_t>(big_endian(bytes, 4))) / 1048576.0;
    case 2: {
      const double fraction = static_cast<double>(big_endian(bytes, 4)) / 4294967296.0;
      return same_bits<std::int16_t>(static_cast<std::uint16_t>(big_endian(bytes + 4, 2))) + fraction;
    }
    default:
      return same_bits<double>(big_endian(bytes, 8));
  }
}

struct Packet {
  std::uint16_t id;  ///< with its format
  const std::uint8_t* bytes;
  std::size_t size;
};

template <std::size_t kCount>
bool numbers(const Packet& packet, std::array<double, kCount>& out, bool& has) noexcept {
  const auto format = static_cast<std::uint16_t>(packet.id & kFormatMask);
  const std::size_t each = kNumberBytes[format];
  if (packet.size != kCount * each) return false;
  for (std::size_t i = 0; i < kCount; ++i) out[i] = number(packet.bytes + i * each, format);
  return has = true;
}

template <class Value>
bool whole(const Packet& packet, Value& out, bool& has) noexcept {
  if (packet.size != sizeof out) return false;
  out = static_cast<Value>(big_endian(packet.bytes, packet.size));
  return has = true;
}

bool take(const Packet& packet, MtData2& out) noexcept {
  switch (packet.id & ~(kFormatMask | kAxesMask)) {
    case kCounter:
      return whole(packet, out.counter, out.has_counter);
    case kTime:
      return whole(packet, out.time_100us, out.has_time);
    case kStatus:
      return whole(packet, out.status, out.has_status);
    case kRate:
      return numbers(packet, out.rate_rad_s, out.has_rate);
    case kForce:
      return numbers(packet, out.force_m_s2, out.has_force);
    case kQuaternion:
      out.world_is_down = (packet.id & kAxesMask) == kAxesDown;
      return numbers(packet, out.quaternion_wxyz, out.has_quaternion);
    default:
      return true;
  }
}

}  // namespace

bool decode_mtdata2(const std::uint8_t* data, std::size_t size, MtData2& out) noexcept {
  constexpr std::size_t kHeader = 3;
  out = {};
  for (std::size_t at = 0; at < size;) {
    if (size - at < kHeader || size - at - kHeader < data[at + 2]) return false;
    const Packet packet{static_cast<std::uint16_t>(big_endian(&data[at], 2)), &data[at + kHeader],
                        data[at + 2]};
    if (!take(packet, out)) return false;
    at += kHeader + packet.size;
  }
  return true;
}

}  // namespace sprung::imu
