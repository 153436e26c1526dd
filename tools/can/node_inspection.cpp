#include "tools/can/node_inspection.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_frames.h"
#include "tools/can/decode/object_value.h"

namespace sprung {

using canopen::ObjectId;

namespace {

/// SYNC comes every few ms, heartbeats of masters at least ten times a second.
constexpr double kMaster_s = 0.2;
constexpr double kHeartbeat_s = 0.25;  // producers are set to 5-100 ms
constexpr double kGuard_s = 0.05;
constexpr int kProbesAtOnce = 8;  // an interface's queue holds 10 frames by default (facts canopen 5)
constexpr double kProbe_s = 0.03;
constexpr std::uint16_t kDeviceName = 0x1008;
constexpr int kLongestHistory = 16;  // Elmo Gold; EPOS2 keeps 5 (facts canopen 1.3)

/// "0x6041:00 status word" -> its value in words; nothing where the node has no such object.
std::optional<std::string> value_text(SdoSession& session, const canopen::Eds* eds, ObjectId object) {
  const canopen::EdsObject* described = eds != nullptr ? eds->find(object) : nullptr;
  if (eds != nullptr && described == nullptr) return std::nullopt;
  const SdoAnswer answer = session.read(object);
  if (!answer.done()) return std::nullopt;
  return with_unit(cantools::object_value(described, object, answer.bytes.data(), answer.bytes.size()));
}

void add(std::vector<ReportLine>& report, SdoSession& session, const canopen::Eds* eds, const char* name,
         ObjectId object) {
  if (const auto text = value_text(session, eds, object)) report.push_back({name, *text});
}

/// By its heartbeat, else by asking as node guarding does; a node without either stays unknown.
std::string nmt_state(SdoSession& session) {
  canopen::NmtState state = canopen::NmtState::kUnknown;
  const auto hear = [&](const CanFrame& frame) {
    if (frame.error || frame.remote || frame.id != canopen::heartbeat_id(session.node())) return true;
    state = canopen::heartbeat_state(frame);
    return state == canopen::NmtState::kUnknown;
  };
  listen(session.bus(), kHeartbeat_s, hear);
  if (state != canopen::NmtState::kUnknown) return canopen::nmt_text(state);
  const CanFrame request = canopen::guard_request(session.node());
  session.bus().send(&request, 1);
  listen(session.bus(), kGuard_s, hear);
  if (state == canopen::NmtState::kUnknown) return "unknown: no heartbeat, and guarding is not answered";
  return std::string(canopen::nmt_text(state)) + " (no heartbeat; asked by node guarding)";
}

void add_history(std::vector<ReportLine>& report, SdoSession& session) {
  const SdoAnswer count = session.read({canopen::kErrorHistory, 0});
  if (!count.done()) return;
  if (count.number() == 0) report.push_back({"error history", "empty"});
  const int entries = static_cast<int>(std::min<std::uint32_t>(count.number(), kLongestHistory));
  for (int i = 1; i <= entries; ++i) {
    const ObjectId object{canopen::kErrorHistory, static_cast<std::uint8_t>(i)};
    const SdoAnswer entry = session.read(object);
    if (!entry.done()) return;
    report.push_back({i == 1 ? "error history, newest" : "error history",
                      cantools::object_value(nullptr, object, entry.bytes.data(), entry.bytes.size()).text});
  }
}

void add_supply(std::vector<ReportLine>& report, SdoSession& session, const cantools::NodeDescription& node,
                const DriveTiming& timing) {
  if (!node.actuator) return;
  const auto profile = make_profile(*node.actuator, timing);
  const ObjectId object = profile->supply_voltage_object();
  if (object.index == 0) return;
  const SdoAnswer answer = session.read(object);
  if (!answer.done()) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.2f V", profile->supply_V(answer.number()));
  report.push_back({"supply", text});
}

}  // namespace

bool bridge_drives(CanBus& bus) {
  bool heard = false;
  listen(bus, kMaster_s, [&heard](const CanFrame& frame) {
    const bool master = frame.id == canopen::kSyncId ||
                        frame.id == canopen::heartbeat_id(canopen::kBridgeNode);
    heard = heard || (!frame.error && !frame.remote && master);
    return !heard;
  });
  return heard;
}

void refuse_while_driven(CanBus& bus, bool force) {
  if (force || !bridge_drives(bus)) return;
  throw std::runtime_error(
      "a bridge drives " + bus.describe() +
      " (SYNC or its heartbeat was heard): sprung down first, or --force if you know what it does");
}

std::vector<FoundNode> scan_nodes(CanBus& bus) {
  std::array<FoundNode, canopen::kMaxNode + 1> found{};
  const auto take = [&found](const CanFrame& frame) {
    const int node = static_cast<int>(frame.id) - static_cast<int>(canopen::kSdoServerBase);
    if (frame.error || frame.remote || node < 1 || node > canopen::kMaxNode) return true;
    const canopen::SdoMessage reply = canopen::decode_sdo_reply(frame);
    if (!(reply.object == ObjectId{canopen::kDeviceType, 0}))
      return true;  // answers somebody else's question
    FoundNode& one = found[node];
    one.node = node;
    ++one.answers;
    if (reply.kind == canopen::SdoKind::kUpload) one.device_type = reply.value;
    return true;
  };
  for (int first = 1; first <= canopen::kMaxNode; first += kProbesAtOnce) {
    for (int node = first; node < first + kProbesAtOnce && node <= canopen::kMaxNode; ++node) {
      const CanFrame request = canopen::sdo_read_request(node, {canopen::kDeviceType, 0});
      bus.send(&request, 1);
    }
    listen(bus, kProbe_s, take);
  }
  std::vector<FoundNode> nodes;
  std::copy_if(found.begin(), found.end(), std::back_inserter(nodes),
               [](const FoundNode& node) { return node.answers > 0; });
  return nodes;
}

std::vector<ReportLine> identify_node(SdoSession& session, const canopen::Eds* eds) {
  std::vector<ReportLine> report;
  add(report, session, eds, "device name", {kDeviceName, 0});
  add(report, session, eds, "vendor", {canopen::kIdentity, 1});
  add(report, session, eds, "product", {canopen::kIdentity, 2});
  add(report, session, eds, "revision", {canopen::kIdentity, 3});
  add(report, session, eds, "serial number", {canopen::kIdentity, 4});
  return report;
}

std::vector<ReportLine> inspect_node(SdoSession& session, const cantools::NodeDescription& node,
                                     const DriveTiming& timing) {
  const canopen::Eds* eds = node.eds.get();
  (void)session.must_read({canopen::kDeviceType, 0});
  std::vector<ReportLine> report;
  add(report, session, eds, "device type", {canopen::kDeviceType, 0});
  for (ReportLine& line : identify_node(session, eds)) report.push_back(std::move(line));
  report.push_back({"NMT state", nmt_state(session)});
  add(report, session, eds, "state", {canopen::kStatusWord, 0});
  add(report, session, eds, "mode", {canopen::kModeDisplay, 0});
  add(report, session, eds, "position", {canopen::kPositionActual, 0});
  add_supply(report, session, node, timing);
  add(report, session, eds, "error register", {canopen::kErrorRegister, 0});
  add(report, session, eds, "error code", {canopen::kErrorCode, 0});
  add_history(report, session);
  return report;
}

}  // namespace sprung
