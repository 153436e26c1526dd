/// Datagrams of the user-space bus (python-can's msgpack) and the bursts of its lock-step link; and the
/// kernel's frames.
#include <cmath>

#include "drivers/can/kernel_frame.h"
#include "drivers/can/lockstep_burst.h"
#include "drivers/can/udp_datagram.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::drivers_can_datagram {
namespace {

void require_classic(const CanFrame& frame) {
  require(frame.length <= 8, "at most 8 bytes");
  require(frame.error || frame.id <= 0x7FF, "11 bit");
}

/// What was decoded is encoded and decoded to the same again.
void require_round_trip(const StampedFrame& decoded) {
  UdpDatagram datagram;
  encode_datagram(decoded, datagram);
  StampedFrame again;
  require(decode_datagram(datagram.bytes.data(), datagram.size, again), "own datagrams are read");
  CanFrame expected = decoded.frame;
  if (expected.remote) expected.data = {};
  require(again.frame == expected, "the frame comes back");
}

void look_at_datagram(std::string_view bytes, BurstAssembler& bursts) {
  const std::string copy(bytes);
  StampedFrame stamped;
  if (!decode_datagram(copy.data(), copy.size(), stamped)) return;
  require_classic(stamped.frame);
  require_round_trip(stamped);
  BurstStamp stamp;
  if (!decode_stamp(stamped.timestamp, stamp)) return;
  require(encode_stamp(stamp) == stamped.timestamp, "stamps are exact");
  if (bursts.add(stamp, stamped.frame) == BurstEvent::kComplete)
    require(bursts.frames().size() == static_cast<std::size_t>(stamp.count), "a burst is whole");
}

void look_at_kernel_frame(Input& input) {
  can_frame raw{};
  raw.can_id = input.number<std::uint32_t>();
  raw.can_dlc = input.byte();
  for (std::uint8_t& byte : raw.data) byte = input.byte();
  CanFrame frame;
  if (!from_kernel(raw, frame)) return;
  require_classic(frame);
  CanFrame again;
  require(from_kernel(to_kernel(frame), again) && again.id == frame.id, "the identifier comes back");
}

std::string datagram(const CanFrame& frame, double timestamp) {
  StampedFrame stamped;
  stamped.frame = frame;
  stamped.timestamp = timestamp;
  UdpDatagram out;
  encode_datagram(stamped, out);
  return {out.bytes.data(), out.size};
}

std::vector<std::string> datagram_seeds() {
  CanFrame frame;
  frame.id = 0x181;
  frame.length = 8;
  frame.data = {1, 2, 3, 4, 5, 6, 7, 8};
  CanFrame remote;
  remote.id = 0x701;
  remote.remote = true;
  remote.length = 1;
  Output burst;
  for (int i = 0; i < 3; ++i) burst.byte(0).piece(datagram(frame, encode_stamp({7, 3, i})));
  return {
      Output().byte(0).piece(datagram(frame, 0.0)).byte(0).piece(datagram(remote, 0.0)).bytes(),
      burst.byte(0).piece(datagram(end_of_tick_mark(), encode_stamp({8, 1, 0}))).bytes(),
      Output().byte(1).number(CAN_ERR_FLAG | 0x40U).byte(8).text("abcdefgh").bytes(),
      Output().byte(2).number(std::int64_t{7}).byte(1).number(0x80000123U).byte(15).text("abcdefgh").bytes()};
}

}  // namespace

SPRUNG_FUZZ(drivers_can_datagram, datagram_seeds) {
  BurstAssembler bursts;
  while (!input.done()) {
    switch (input.byte() % 3) {
      case 0:
        look_at_datagram(input.piece(), bursts);
        break;
      case 1:
        look_at_kernel_frame(input);
        break;
      default:
        bursts.expect(input.number<std::int64_t>());
    }
  }
}

}  // namespace sprung::fuzz::drivers_can_datagram
