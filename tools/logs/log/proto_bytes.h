#pragma once
/// Protocol buffers' wire format (protobuf.dev/programming-guides/encoding), as far as MCAP files need it.
/// Pure.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sprung::log {

/// How a value's end is found; the lowest three bits of a tag.
enum class ProtoWire : std::uint8_t { kVarint = 0, kFixed64 = 1, kLength = 2, kFixed32 = 5 };

inline constexpr std::size_t kLongestVarint = 10;

/// 7 bits a byte, the lowest first. @param to has room for kLongestVarint. @return behind the last byte.
inline char* put_varint(std::uint64_t value, char* to) noexcept {
  for (; value >= 0x80; value >>= 7U) *to++ = static_cast<char>((value & 0x7FU) | 0x80U);
  *to++ = static_cast<char>(value);
  return to;
}

inline std::size_t varint_size(std::uint64_t value) noexcept {
  std::size_t size = 1;
  for (; value >= 0x80; value >>= 7U) ++size;
  return size;
}

inline void append_varint(std::uint64_t value, std::string& out) {
  char bytes[kLongestVarint];
  out.append(bytes, put_varint(value, bytes));
}

inline void append_tag(std::size_t field, ProtoWire wire, std::string& out) {
  append_varint(field << 3U | static_cast<std::uint64_t>(wire), out);
}

inline void append_number(std::size_t field, std::uint64_t value, std::string& out) {
  append_tag(field, ProtoWire::kVarint, out);
  append_varint(value, out);
}

/// A text, bytes, or a message that is encoded already.
inline void append_delimited(std::size_t field, std::string_view content, std::string& out) {
  append_tag(field, ProtoWire::kLength, out);
  append_varint(content.size(), out);
  out += content;
}

}  // namespace sprung::log
