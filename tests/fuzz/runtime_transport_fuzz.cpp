/// Datagrams of LCM's protocol, one after the other, from several senders and with time between them.
#include <cstring>
#include <memory>

#include "runtime/transport/fragment_store.h"
#include "runtime/transport/lcm_packet.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::runtime_transport {
namespace {

constexpr std::size_t kLongest = 120;  ///< of a fuzzed datagram; sizes that fragments claim are in its header
/// Room for larger ones is made in the same way, and takes all of the time.
constexpr std::size_t kLargestMade = 4U << 10U;

struct Datagram {
  DatagramSender sender;
  std::int64_t later_us = 0;  ///< than the one before
  std::string_view bytes;
};

Datagram next_datagram(Input& input) {
  Datagram datagram;
  const std::uint8_t head = input.byte();
  datagram.sender.address = head & 3U;
  datagram.sender.port = head >> 2U & 3U;
  datagram.later_us = std::int64_t{head >> 4U} * 100'000;
  datagram.bytes = input.text(std::min<std::size_t>(input.number<std::uint16_t>(), kLongest));
  return datagram;
}

void require_promises(const LcmPacket& packet, const std::uint8_t* bytes, std::size_t size) {
  require(packet.data >= bytes && packet.data + packet.size <= bytes + size, "data lies in the datagram");
  const bool first = !packet.fragment || packet.number == 0;
  require(packet.channel.empty() != first && packet.channel.size() <= kLongestChannel,
          "a channel of 1 to 63");
  if (!packet.fragment) return;
  require(packet.number < packet.count && packet.count > 1, "a number below the count");
  require(std::uint64_t{packet.offset} + packet.size <= packet.message_size, "within its message");
}

void look_at(const Datagram& datagram, FragmentStore& store, std::int64_t now_us) {
  // An exact copy, so that one byte beyond it is seen.
  const std::unique_ptr<std::uint8_t[]> copy(new std::uint8_t[datagram.bytes.size()]);
  std::memcpy(copy.get(), datagram.bytes.data(), datagram.bytes.size());
  LcmPacket packet;
  if (parse_lcm_packet(copy.get(), datagram.bytes.size(), packet) != PacketFault::kNone) return;
  require_promises(packet, copy.get(), datagram.bytes.size());
  if (!packet.fragment) return;
  if (packet.message_size > kLargestMade && packet.message_size <= FragmentStore::kLargestMessage) return;
  const FragmentStore::Message* whole = store.add(datagram.sender, packet, now_us);
  if (whole == nullptr) return;
  require(whole->bytes.size() == packet.message_size, "a whole message has its size");
  require(!whole->channel.empty() && whole->channel.size() <= kLongestChannel, "and its channel");
}

std::string number_text(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

std::string fragment(std::uint32_t size, std::uint32_t offset, int number, int count,
                     const std::string& bytes) {
  const auto u16 = [](int value) { return number_text(static_cast<std::uint32_t>(value), 2); };
  return "LC03" + number_text(7, 4) + number_text(size, 4) + number_text(offset, 4) + u16(number) +
         u16(count) + bytes;
}

std::vector<std::string> transport_seeds() {
  const std::string zero(1, '\0');
  const std::string channel = "CAN_TRACE" + zero;
  const std::string twice(20, 'a');
  return {Output().byte(0).piece("LC02" + number_text(1, 4) + "IMU" + zero + "some bytes").bytes(),
          Output()
              .byte(0)
              .piece(fragment(40, 0, 0, 2, channel + twice))
              .byte(0x10)
              .piece(fragment(40, 20, 1, 2, twice))
              .bytes(),
          Output()
              .byte(0)
              .piece(fragment(60, 40, 2, 3, twice))
              .byte(0)
              .piece(fragment(60, 20, 1, 3, twice))
              .byte(1)
              .piece(fragment(60, 20, 1, 3, twice))
              .byte(0xF0)
              .piece(fragment(60, 0, 0, 3, channel + twice))
              .bytes(),
          Output().byte(0).piece(fragment(16U << 20U, 0, 0, 300, channel + twice)).bytes()};
}

}  // namespace

SPRUNG_FUZZ(runtime_transport, transport_seeds) {
  FragmentStore store;
  std::int64_t now_us = 0;
  while (!input.done()) {
    const Datagram datagram = next_datagram(input);
    now_us += datagram.later_us;
    look_at(datagram, store, now_us);
  }
}

}  // namespace sprung::fuzz::runtime_transport
