#pragma once
/// One simulated node with the dictionary of an EDS and an application that only notes what it is told; and a
/// client by hand that reads and writes its objects, expedited and in segments.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drivers/canopen/eds.h"
#include "simulation/node/canopen_device.h"
#include "tests/support/paths.h"

namespace sprung::sim {

inline canopen::Eds load_eds(const std::string& device, int node) {
  const std::string path = test::source_dir() + "/drivers/profiles/" + device + "/" + device;
  const auto text = [&path](const std::string& ending) -> std::string {
    std::ifstream in(path + ending, std::ios::binary);
    EXPECT_TRUE(in) << path << ending;
    return {std::istreambuf_iterator<char>(in), {}};
  };
  return canopen::parse_eds(text(".eds"), path + ".eds", node, text(".extra.ini"));
}

class NodeBench : public DeviceApplication {
 public:
  static constexpr int kNode = 3;

  explicit NodeBench(const std::string& device, const DevicePolicy& policy = {})
      : NodeBench(load_eds(device, kNode), policy) {}
  explicit NodeBench(const canopen::Eds& eds, const DevicePolicy& policy = {})
      : dictionary(eds), node(kNode, dictionary, *this, outbox, policy) {
    outbox.open(&out);
    node.tick(0);
  }

  std::uint32_t check_write(canopen::ObjectId id, std::int64_t value) noexcept override {
    asked_value = value;
    return id.index == refused_index ? refusal : 0;
  }
  std::uint32_t check_read(canopen::ObjectId id) noexcept override {
    return id.index == refused_index ? refusal : 0;
  }
  void written(canopen::ObjectId id) noexcept override { last_written = id.index; }
  /// Shows the number of SYNCs as the position, where the device has one.
  void synced() noexcept override {
    ++syncs;
    if (dictionary.has({0x6064, 0})) dictionary.set({0x6064, 0}, syncs);
  }
  void connection_lost() noexcept override { ++lost; }
  void connection_back() noexcept override { ++back; }
  void reset() noexcept override { ++resets; }

  void receive(const CanFrame& frame) { node.receive(frame, time_us); }
  void nmt(canopen::NmtCommand command, int whom = kNode) { receive(canopen::nmt_frame(command, whom)); }
  void tick_until(std::int64_t end_us) {
    for (; time_us < end_us; time_us += 250) node.tick(time_us);
    time_us = end_us;
    node.tick(time_us);
  }
  /// Frames of one identifier since the last drop().
  std::vector<CanFrame> frames(std::uint32_t id) const {
    std::vector<CanFrame> found;
    for (const BusFrame& entry : out) {
      if (entry.frame.id == id) found.push_back(entry.frame);
    }
    return found;
  }
  void drop() { out.clear(); }
  std::vector<int> emergencies() const {
    std::vector<int> codes;
    for (const CanFrame& frame : frames(canopen::emcy_id(kNode)))
      codes.push_back(static_cast<int>(canopen::get_le(frame.data.data(), 2)));
    return codes;
  }

  /// The one reply to a request; kInvalid when there is none.
  canopen::SdoMessage ask(const CanFrame& request, CanFrame* raw = nullptr) {
    drop();
    receive(request);
    const auto replies = frames(canopen::sdo_server_id(kNode));
    if (replies.size() != 1) return {};
    if (raw != nullptr) *raw = replies[0];
    return canopen::decode_sdo_reply(replies[0]);
  }
  /// @return 0 or the abort code.
  std::uint32_t write(int index, int sub, std::int64_t value, int size) {
    const auto reply = ask(
        canopen::sdo_write_request(kNode, id(index, sub), static_cast<std::uint32_t>(value), size));
    EXPECT_NE(reply.kind, canopen::SdoKind::kInvalid) << "no reply";
    return reply.kind == canopen::SdoKind::kAbort ? reply.value : 0;
  }
  /// @return the value, or the abort code.
  std::uint32_t read(int index, int sub = 0) {
    const auto reply = ask(canopen::sdo_read_request(kNode, id(index, sub)));
    EXPECT_NE(reply.kind, canopen::SdoKind::kInvalid) << "no reply";
    return reply.value;
  }
  /// In segments. @return 0 or the abort code.
  std::uint32_t write_bytes(int index, int sub, const std::string& bytes) {
    auto reply = ask(canopen::sdo_write_begin(kNode, id(index, sub), bytes.size()));
    bool toggle = false;
    for (std::size_t at = 0; at < bytes.size() && reply.kind != canopen::SdoKind::kAbort; at += 7) {
      const std::string part = bytes.substr(at, 7);
      const auto* data = reinterpret_cast<const std::uint8_t*>(part.data());
      const bool last = at + 7 >= bytes.size();
      reply = ask(canopen::sdo_write_segment(kNode, toggle, data, static_cast<int>(part.size()), last));
      toggle = !toggle;
    }
    return reply.kind == canopen::SdoKind::kAbort ? reply.value : 0;
  }
  /// In segments; "" with an abort.
  std::string read_bytes(int index, int sub = 0) {
    std::string bytes;
    auto reply = ask(canopen::sdo_read_request(kNode, id(index, sub)));
    if (reply.kind != canopen::SdoKind::kUploadBegin) return bytes;
    for (bool toggle = false, last = false; !last; toggle = !toggle) {
      CanFrame raw;
      reply = ask(canopen::sdo_read_segment_request(kNode, toggle), &raw);
      if (reply.kind != canopen::SdoKind::kUploadSegment) return "";
      bytes.append(reinterpret_cast<const char*>(&raw.data[1]), static_cast<std::size_t>(reply.size));
      last = reply.last;
    }
    return bytes;
  }
  /// By the accepted order (facts canopen 1.5). @param cob_id of the PDO, valid or not.
  void map(int communication, std::uint32_t cob_id, int type, const std::vector<std::uint32_t>& entries) {
    EXPECT_EQ(write(communication, 1, cob_id | 0x80000000U, 4), 0U);
    EXPECT_EQ(write(communication, 2, type, 1), 0U);
    EXPECT_EQ(write(communication + 0x200, 0, 0, 1), 0U);
    int sub = 0;
    for (const std::uint32_t entry : entries) EXPECT_EQ(write(communication + 0x200, ++sub, entry, 4), 0U);
    EXPECT_EQ(write(communication + 0x200, 0, sub, 1), 0U);
    EXPECT_EQ(write(communication, 1, cob_id, 4), 0U);
  }
  void hear_master(int master = canopen::kBridgeNode) {
    receive(canopen::heartbeat_frame(master, canopen::NmtState::kOperational));
  }
  static canopen::ObjectId id(int index, int sub = 0) {
    return {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)};
  }

  ObjectDictionary dictionary;
  FrameBatch out;
  Outbox outbox{0};
  CanopenDevice node;
  std::int64_t time_us = 0;
  int last_written = 0;
  int syncs = 0;
  int lost = 0;
  int back = 0;
  int resets = 0;
  int refused_index = -1;  ///< the application refuses this object with `refusal`
  std::uint32_t refusal = 0;
  std::int64_t asked_value = 0;
};

}  // namespace sprung::sim
