#pragma once
/// One datagram of LCM's network protocol ("udpm", LCM's docs/content/udp-multicast-protocol.md; all numbers
/// big endian):
///
///   short     'LC02' | seq 4 | channel, a zero | message
///   fragment  'LC03' | seq 4 | message's size 4 | offset in it 4 | number 2 | how many 2 | bytes of it
///
/// The first fragment's bytes begin with the channel and its zero, which count neither in size nor in offset.
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sprung {

inline constexpr std::size_t kLongestChannel = 63;  ///< LCM_MAX_CHANNEL_NAME_LENGTH

enum class PacketFault : std::int8_t { kNone = 0, kTooShort, kNotLcm, kBadChannel, kBadFragment };

struct LcmPacket {
  std::uint32_t seq = 0;               ///< the sender's count of messages
  std::string_view channel;            ///< empty in all fragments but the first
  const std::uint8_t* data = nullptr;  ///< in the datagram
  std::size_t size = 0;
  bool fragment = false;
  // Of a fragment only:
  std::uint32_t message_size = 0;
  std::uint32_t offset = 0;  ///< of data in the message
  std::uint16_t number = 0;  ///< from 0
  std::uint16_t count = 0;
};

/// Looks at `size` bytes and nothing beyond them. Unless kNone, `out` is unspecified. kNone promises: a short
/// message has a channel of 1 to 63 bytes; a fragment lies within its message, number < count, count > 1, and
/// number 0 alone has offset 0 and a channel.
PacketFault parse_lcm_packet(const void* bytes, std::size_t size, LcmPacket& out) noexcept;

}  // namespace sprung
