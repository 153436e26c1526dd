/// Any frames to the CANopen node that all simulated devices share, with the objects of each: SDO server,
/// object dictionary, mappings, heartbeats, guarding, emergencies. simulation_device has whole devices, and
/// is slower.
#include "drivers/canopen/eds.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "drivers/profiles/profile_eds.h"
#include "simulation/node/canopen_device.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::simulation_node {
namespace {

constexpr int kNode = 1;

const std::vector<sim::ObjectDictionary>& dictionaries() {
  static const std::vector<sim::ObjectDictionary> all = [] {
    std::vector<sim::ObjectDictionary> made;
    for (const ProfileKind* kind : profile_kinds()) made.emplace_back(profile_eds(*kind, kNode));
    return made;
  }();
  return all;
}

class Bench : public sim::DeviceApplication {
 public:
  Bench(const sim::ObjectDictionary& dictionary, const sim::DevicePolicy& policy)
      : dictionary_(dictionary), device_(kNode, dictionary_, *this, outbox_, policy) {
    outbox_.open(&out_);
    device_.tick(0);
  }
  void hear(Input& input) {
    CanFrame frame = frame_of(input);
    if ((frame.id & 1U) != 0) frame.id = (frame.id & 0x780U) + kNode;
    if ((frame.id & 6U) == 6) frame.id = canopen::sdo_client_id(kNode);
    hear(frame);
  }
  void write(Input& input) {
    const canopen::ObjectId object{input.number<std::uint16_t>(), input.byte()};
    const auto value = input.number<std::uint32_t>();
    hear(canopen::sdo_write_request(kNode, object, value, 1 + input.byte() % 4));
  }
  void wait(std::int64_t us) {
    time_us_ += us;
    device_.tick(time_us_);
    check();
  }
  void err(std::uint16_t code, bool on) {
    on ? device_.raise(code) : device_.clear(code);
    check();
  }

 private:
  void written(canopen::ObjectId) noexcept override {}
  void connection_lost() noexcept override {}
  void connection_back() noexcept override {}
  void reset() noexcept override {}
  void hear(const CanFrame& frame) {
    device_.receive(frame, time_us_);
    check();
  }
  void check() {
    for (const BusFrame& item : out_)
      require(item.frame.length <= 8 && item.frame.id <= 0x7FF, "frames are frames");
    require(out_.overflow() == 0, "they fit");
    out_.clear();
  }

  sim::ObjectDictionary dictionary_;
  sim::Outbox outbox_{0};
  FrameBatch out_;
  sim::CanopenDevice device_;
  std::int64_t time_us_ = 0;
};

std::vector<std::string> node_seeds() {
  using namespace canopen;
  const auto hear = [](const CanFrame& frame) { return Output().byte(0).text(frame_bytes(frame)).bytes(); };
  const auto write = [](std::uint16_t index, int sub, std::uint32_t value, int size) {
    return Output().byte(1).number(index).byte(sub).number(value).byte(size - 1).bytes();
  };
  const std::string map = write(kTpdoCommunication, 1, 0xC0000181, 4) + write(kTpdoMapping, 0, 0, 1) +
                          write(kTpdoMapping, 1, 0x60640020, 4) + write(kTpdoMapping, 0, 1, 1) +
                          write(kTpdoCommunication, 2, 1, 1) + write(kTpdoCommunication, 1, 0x40000181, 4);
  std::vector<std::string> seeds;
  for (std::size_t device = 0; device < dictionaries().size(); ++device) {
    const std::string head = Output().byte(static_cast<int>(device)).byte(0).bytes();
    seeds.push_back(head + map + hear(nmt_frame(NmtCommand::kStart, kNode)) + hear(sync_frame()) +
                    hear(sync_frame()));
    seeds.push_back(head + write(kStoreParameters, 1, 0x65766173, 4) +
                    hear(nmt_frame(NmtCommand::kResetNode, 0)));
    seeds.push_back(head + write(kHeartbeatConsumer, 1, (127U << 16U) + 20, 4) +
                    hear(heartbeat_frame(127, NmtState::kOperational)) +
                    Output().byte(2).number(std::uint16_t{30'000}).bytes());
    seeds.push_back(head + hear(sdo_read_request(kNode, {0x1008, 0})) +
                    hear(sdo_read_segment_request(kNode, false)));
    seeds.push_back(head + hear(sdo_write_begin(kNode, {0x1010, 1}, 9)) + hear(guard_request(kNode)));
    seeds.push_back(head + Output().byte(3).number(std::uint16_t{0x8130}).byte(1).bytes() +
                    hear(sdo_read_request(kNode, {0x1003, 1})));
  }
  return seeds;
}

}  // namespace

/// Whose objects, policy; then frames, writes, time, errors.
SPRUNG_FUZZ(simulation_node, node_seeds) {
  const sim::ObjectDictionary& dictionary = dictionaries()[input.byte() % dictionaries().size()];
  const std::uint8_t bits = input.byte();
  sim::DevicePolicy policy;
  if ((bits & 1U) != 0) policy.remap_in_operational = canopen::kAbortMaxonNmtState;
  policy.short_pdo_loses_connection = (bits & 2U) != 0;
  policy.after_communication_error = static_cast<int>(bits >> 2U & 3U);
  policy.lss = (bits & 16U) != 0;
  if ((bits & 32U) != 0) policy.factory_node = canopen::kNoNode;
  policy.events_on_change = (bits & 64U) == 0;
  Bench bench(dictionary, policy);
  for (int left = 300; left > 0 && !input.done(); --left) {
    const int what = input.byte() % 4;
    if (what == 0) bench.hear(input);
    if (what == 1) bench.write(input);
    if (what == 2) bench.wait(input.number<std::uint16_t>());
    if (what == 3) {
      const auto code = input.number<std::uint16_t>();
      bench.err(code, (input.byte() & 1U) != 0);
    }
  }
}

}  // namespace sprung::fuzz::simulation_node
