/// Any frames into what `sprung can dump` says of them; what an SDO transfer said changes how later ones are
/// read.
#include <nlohmann/json.hpp>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"
#include "tools/can/decode/frame_decoder.h"
#include "tools/can/decode/frame_line.h"
#include "tools/can/decode/pcapng_bytes.h"

namespace sprung::fuzz::tools_can_decode {
namespace {

using namespace cantools;

const BusDescription& description() {
  static const BusDescription of_pegasus = describe_buses(load_robot(test::source_dir() + "/robots/pegasus"));
  return of_pegasus;
}

std::vector<std::string> decode_seeds() {
  using namespace canopen;
  const auto frame = [](const CanFrame& one) {
    return Output().byte(0).number(std::uint32_t{1}).text(frame_bytes(one)).bytes();
  };
  const std::uint8_t name[] = {'E', 'P', 'O', 'S'};
  CanFrame sample;
  sample.id = tpdo_id(0, 1);
  sample.length = 8;
  return {frame(nmt_frame(NmtCommand::kStart, 0)) + frame(sync_frame()) + frame(sample),
          frame(sdo_read_request(1, {0x1008, 0})) + frame(sdo_read_begin_reply(1, {0x1008, 0}, 4)) +
              frame(sdo_read_segment_request(1, false)) +
              frame(sdo_read_segment_reply(1, false, name, 4, true)),
          frame(sdo_write_request(1, {0x1A00, 0}, 0, 1)) + frame(sdo_write_reply(1, {0x1A00, 0})) +
              frame(sdo_write_request(1, {0x1A00, 1}, 0x60410010, 4)) +
              frame(sdo_write_reply(1, {0x1A00, 1})) + frame(sdo_write_request(1, {0x1A00, 0}, 1, 1)) +
              frame(sdo_write_reply(1, {0x1A00, 0})) + frame(sample),
          frame(guard_request(1)) + frame(heartbeat_frame(1, NmtState::kOperational)) +
              frame(emergency_frame(1, {0x8130, 17, {}}))};
}

}  // namespace

/// Bus, time since the one before, frame; again and again.
SPRUNG_FUZZ(tools_can_decode, decode_seeds) {
  FrameDecoder decoder(description());
  ObservedFrame observed;
  while (!input.done()) {
    observed.bus = input.byte() % static_cast<int>(description().buses.size());
    observed.time_us += input.number<std::uint32_t>();
    observed.frame = frame_of(input);
    const DecodedFrame decoded = decoder.decode(observed);
    require(!frame_line(observed, decoded, "leg", 0).empty(), "a line");
    require(!frame_json(observed, decoded, "leg", 0).dump().empty(), "JSON");
    require(pcapng_packet(observed, observed.time_us).size() % 4 == 0, "a block of words");
  }
}

}  // namespace sprung::fuzz::tools_can_decode
