#include "runtime/transport/lcm_packet.h"

#include <cstring>

namespace sprung {
namespace {

constexpr std::uint32_t kShort = 0x4c433032, kFragment = 0x4c433033;  // LC02, LC03
constexpr std::size_t kShortHeader = 8, kFragmentHeader = 20;

std::uint32_t number_at(const std::uint8_t* bytes, std::size_t from, std::size_t size) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | bytes[from + i];
  return value;
}

/// Takes the channel and its zero off the front of `packet.data`.
bool take_channel(LcmPacket& packet) noexcept {
  const std::size_t within = packet.size < kLongestChannel + 1 ? packet.size : kLongestChannel + 1;
  const void* const zero = within == 0 ? nullptr : std::memchr(packet.data, 0, within);
  if (zero == nullptr) return false;
  const auto length = static_cast<std::size_t>(static_cast<const std::uint8_t*>(zero) - packet.data);
  packet.channel = std::string_view(reinterpret_cast<const char*>(packet.data), length);
  packet.data += length + 1;
  packet.size -= length + 1;
  return length > 0;
}

PacketFault parse_fragment(const std::uint8_t* bytes, LcmPacket& out) noexcept {
  out.message_size = number_at(bytes, 8, 4);
  out.offset = number_at(bytes, 12, 4);
  out.number = static_cast<std::uint16_t>(number_at(bytes, 16, 2));
  out.count = static_cast<std::uint16_t>(number_at(bytes, 18, 2));
  const bool first = out.number == 0;
  if (first && !take_channel(out)) return PacketFault::kBadChannel;
  // LCM 1.3.1 adds offset and size in 32 bits and writes where that leads (lcm-proj/lcm#628).
  const bool within = out.offset <= out.message_size && out.size <= out.message_size - out.offset;
  const bool in_turn = out.number < out.count && out.count > 1 && first == (out.offset == 0);
  return within && in_turn && out.size > 0 ? PacketFault::kNone : PacketFault::kBadFragment;
}

}  // namespace

PacketFault parse_lcm_packet(const void* data, std::size_t size, LcmPacket& out) noexcept {
  const auto* const bytes = static_cast<const std::uint8_t*>(data);
  if (size < kShortHeader) return PacketFault::kTooShort;
  const std::uint32_t magic = number_at(bytes, 0, 4);
  if (magic != kShort && magic != kFragment) return PacketFault::kNotLcm;
  const std::size_t header = magic == kShort ? kShortHeader : kFragmentHeader;
  if (size < header) return PacketFault::kTooShort;
  out = {};
  out.seq = number_at(bytes, 4, 4);
  out.fragment = magic == kFragment;
  out.data = bytes + header;
  out.size = size - header;
  if (out.fragment) return parse_fragment(bytes, out);
  return take_channel(out) ? PacketFault::kNone : PacketFault::kBadChannel;
}

}  // namespace sprung
