#include "tools/can/decode/pcapng_bytes.h"

#include <array>

namespace sprung::cantools {
namespace {

constexpr std::uint32_t kSectionBlock = 0x0A0D0D0A;
constexpr std::uint32_t kInterfaceBlock = 1;
constexpr std::uint32_t kPacketBlock = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;
constexpr std::uint16_t kSocketCanLink = 227;
constexpr std::uint16_t kOptionName = 2;     // if_name
constexpr std::uint16_t kOptionProgram = 4;  // shb_userappl
constexpr std::uint16_t kOptionFlags = 2;    // epb_flags
constexpr std::uint32_t kInbound = 1;
constexpr std::uint32_t kOutbound = 2;

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i)));
}

void pad(std::string& out) {
  while (out.size() % 4 != 0) out.push_back('\0');
}

void put_option(std::string& out, std::uint16_t code, const std::string& value) {
  put(out, code, 2);
  put(out, value.size(), 2);
  out += value;
  pad(out);
}

std::string block(std::uint32_t type, const std::string& body) {
  const std::uint64_t total = body.size() + 12;
  std::string out;
  put(out, type, 4);
  put(out, total, 4);
  out += body;
  put(out, total, 4);
  return out;
}

/// struct can_frame with the identifier in network order.
std::string socketcan_bytes(const CanFrame& frame) {
  const std::uint32_t id = frame.id | (frame.error ? 0x20000000U : 0U) | (frame.remote ? 0x40000000U : 0U);
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(id >> shift));
  put(out, frame.length, 1);
  put(out, 0, 3);
  if (!frame.remote) out.append(reinterpret_cast<const char*>(frame.data.data()), frame.length);
  return out;
}

}  // namespace

std::string pcapng_section(const std::string& program) {
  std::string body;
  put(body, kByteOrderMagic, 4);
  put(body, 1, 2);  // version 1.0
  put(body, 0, 2);
  put(body, ~std::uint64_t{0}, 8);  // length of the section: not told
  put_option(body, kOptionProgram, program);
  put_option(body, 0, "");
  return block(kSectionBlock, body);
}

std::string pcapng_interface(const std::string& bus) {
  std::string body;
  put(body, kSocketCanLink, 2);
  put(body, 0, 2);
  put(body, 0, 4);  // no limit of length; time stamps are microseconds unless said otherwise
  put_option(body, kOptionName, bus);
  put_option(body, 0, "");
  return block(kInterfaceBlock, body);
}

std::string pcapng_packet(const ObservedFrame& observed, std::int64_t utc_us) {
  const std::string bytes = socketcan_bytes(observed.frame);
  std::string body;
  put(body, static_cast<std::uint64_t>(observed.bus), 4);
  put(body, static_cast<std::uint64_t>(utc_us) >> 32, 4);
  put(body, static_cast<std::uint64_t>(utc_us) & 0xFFFFFFFF, 4);
  put(body, bytes.size(), 4);
  put(body, bytes.size(), 4);
  body += bytes;
  pad(body);
  if (observed.direction != Direction::kUnknown) {
    std::string flags;
    put(flags, observed.direction == Direction::kSent ? kOutbound : kInbound, 4);
    put_option(body, kOptionFlags, flags);
    put_option(body, 0, "");
  }
  return block(kPacketBlock, body);
}

}  // namespace sprung::cantools
