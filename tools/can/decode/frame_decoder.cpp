#include "tools/can/decode/frame_decoder.h"

#include <algorithm>
#include <cstdio>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "tools/can/decode/decoded_field.h"
#include "tools/can/decode/word_texts.h"

namespace sprung::cantools {
namespace {

constexpr std::uint32_t kTimeId = 0x100;
constexpr std::uint32_t kFunctionMask = 0x780;
constexpr std::uint32_t kNodeMask = 0x07F;

std::string bytes_text(const CanFrame& frame) {
  std::string text;
  for (int i = 0; i < frame.length; ++i) {
    char pair[4];
    std::snprintf(pair, sizeof pair, "%02X", frame.data[i]);
    text += (i == 0 ? "" : " ") + std::string(pair);
  }
  return text.empty() ? "no data" : text;
}

std::string lss_frame_text(const CanFrame& frame) {
  const std::string sender = frame.id == canopen::kLssMasterId ? "from master " : "from slave ";
  const bool known = canopen::is_lss_request(frame) || canopen::is_lss_reply(frame);
  return sender + (known ? canopen::lss_text(canopen::lss_command(frame)) + std::string(", ") : "") +
         bytes_text(frame);
}

bool is_same_map(const PdoSetting& setting, const PdoTable& pdo) {
  if (static_cast<int>(setting.entries.size()) != pdo.count) return false;
  const auto same = [](const canopen::MapEntry& entry, std::uint32_t word) {
    return canopen::encode_map_entry(entry) == word;
  };
  return std::equal(setting.entries.begin(), setting.entries.end(), pdo.words.begin(), same);
}

/// Whether the node sends what the bridge wants of it: another map cannot be read as the profile's sample.
bool is_as_configured(const NodeDescription& node, const PdoTable& pdo) {
  for (const PdoSetting& setting : node.pdos) {
    if (setting.transmit == pdo.transmit && setting.number == pdo.number) return is_same_map(setting, pdo);
  }
  return false;
}

/// Which PDO an identifier is by CiA 301's predefined set; false for other identifiers.
bool predefined_pdo(std::uint32_t id, bool& transmit, int& number) {
  const std::uint32_t function = id & kFunctionMask;
  if (function < canopen::kTpdoBase || function >= canopen::kSdoServerBase) return false;
  transmit = (function & 0x080) != 0;
  number = static_cast<int>((function - (transmit ? canopen::kTpdoBase : canopen::kRpdoBase)) / 0x100);
  return true;
}

}  // namespace

FrameDecoder::FrameDecoder(const BusDescription& description)
    : description_(description), pdos_(description) {}

void FrameDecoder::set_node(const ObservedFrame& observed, int node, DecodedFrame& out) const {
  out.node = node;
  out.node_name = description_.node_name(observed.bus, node);
}

const canopen::EdsObject* FrameDecoder::find(int bus, int node, canopen::ObjectId object) const {
  const NodeDescription* known = description_.find(bus, node);
  return known != nullptr && known->eds != nullptr ? known->eds->find(object) : nullptr;
}

std::string FrameDecoder::object_name(int bus, int node, canopen::ObjectId object) const {
  const NodeDescription* known = description_.find(bus, node);
  if (known != nullptr && known->eds != nullptr && known->eds->find(object) != nullptr)
    return known->eds->name_of(object);
  return canopen::object_name(object.index);
}

std::string FrameDecoder::object_text(int bus, int node, canopen::ObjectId object) const {
  return canopen::id_text(object) + " " + object_name(bus, node, object);
}

DecodedFrame FrameDecoder::decode(const ObservedFrame& observed) {
  const CanFrame& frame = observed.frame;
  DecodedFrame out;
  if (frame.error) {
    out.kind = FrameKind::kError;
    out.text = error_frame_text(frame);
  } else if (frame.id == canopen::kNmtId) {
    decode_nmt(observed, out);
  } else if (frame.id == canopen::kSyncId) {
    out.kind = FrameKind::kSync;
    if (frame.length > 0) out.text = "counter " + std::to_string(frame.data[0]);
  } else if (frame.id == kTimeId) {
    out.kind = FrameKind::kTime;
    out.text = bytes_text(frame);
  } else if ((frame.id & kFunctionMask) == canopen::kEmcyBase) {
    decode_emergency(observed, out);
  } else if ((frame.id & kFunctionMask) == canopen::kSdoServerBase) {
    decode_sdo(observed, true, out);
  } else if ((frame.id & kFunctionMask) == canopen::kSdoClientBase) {
    decode_sdo(observed, false, out);
  } else if ((frame.id & kFunctionMask) == canopen::kHeartbeatBase) {
    decode_heartbeat(observed, out);
  } else if (frame.id == canopen::kLssMasterId || frame.id == canopen::kLssSlaveId) {
    out.kind = FrameKind::kLss;
    out.text = lss_frame_text(frame);
  } else if (!decode_pdo(observed, out)) {
    out.text = bytes_text(frame);
  }
  return out;
}

void FrameDecoder::decode_nmt(const ObservedFrame& observed, DecodedFrame& out) const {
  out.kind = FrameKind::kNmt;
  const CanFrame& frame = observed.frame;
  canopen::NmtCommand command{};
  if (frame.length != 2 || !canopen::decode_nmt(frame, frame.data[1], command)) {
    out.text = "not understood: " + bytes_text(frame);
    return;
  }
  const int node = frame.data[1];
  if (node == 0) {
    out.node_name = "all nodes";
  } else {
    set_node(observed, node, out);
  }
  out.text = canopen::nmt_text(command);
}

void FrameDecoder::decode_emergency(const ObservedFrame& observed, DecodedFrame& out) const {
  out.kind = FrameKind::kEmergency;
  set_node(observed, static_cast<int>(observed.frame.id & kNodeMask), out);
  canopen::Emergency emergency;
  if (!canopen::decode_emergency(observed.frame, emergency)) {
    out.text = "not understood: " + bytes_text(observed.frame);
    return;
  }
  char code[16];
  std::snprintf(code, sizeof code, "0x%04X ", emergency.code);
  out.text = code + std::string(canopen::emergency_text(emergency.code)) +
             "; error register: " + canopen::error_register_text(emergency.error_register).data();
  for (const std::uint8_t byte : emergency.maker) {
    if (byte == 0) continue;
    char maker[40];
    std::snprintf(maker, sizeof maker, "; maker's bytes %02X %02X %02X %02X %02X", emergency.maker[0],
                  emergency.maker[1], emergency.maker[2], emergency.maker[3], emergency.maker[4]);
    out.text += maker;
    break;
  }
}

bool FrameDecoder::decode_pdo(const ObservedFrame& observed, DecodedFrame& out) const {
  const CanFrame& frame = observed.frame;
  const PdoTable* known = pdos_.find(observed.bus, frame.id);
  bool transmit = false;
  int number = 0;
  if (known == nullptr && !predefined_pdo(frame.id, transmit, number)) return false;
  if (known != nullptr) {
    transmit = known->transmit;
    number = known->number;
  }
  out.kind = transmit ? FrameKind::kTpdo : FrameKind::kRpdo;
  set_node(observed, known != nullptr ? known->node : static_cast<int>(frame.id & kNodeMask), out);
  out.text = std::to_string(number + 1) + ": ";
  if (frame.remote) {
    out.text += "remote request";
  } else if (known == nullptr || !known->mapped) {
    out.text += bytes_text(frame) + " (map not known)";
  } else if (known->bits() != 8 * frame.length) {
    out.text += bytes_text(frame) + " (" + std::to_string(frame.length) + " bytes, the map has " +
                std::to_string(known->bits() / 8) + ")";
  } else {
    out.fields = decode_fields(*known, frame);
    out.text += fields_text(out.fields);
  }
  return true;
}

std::vector<DecodedField> FrameDecoder::decode_fields(const PdoTable& pdo, const CanFrame& frame) const {
  const NodeDescription* node = description_.find(pdo.bus, pdo.node);
  if (node != nullptr && node->card && pdo.count > 0 && is_as_configured(*node, pdo)) {
    const canopen::MapEntry entry = canopen::decode_map_entry(pdo.words[0]);
    std::vector<DecodedField> fields = card_fields(*node, entry.object, frame);
    if (!fields.empty()) return fields;
  }
  std::vector<DecodedField> fields;
  std::size_t at = 0;
  for (int i = 0; i < pdo.count; ++i) {
    const canopen::MapEntry entry = canopen::decode_map_entry(pdo.words[i]);
    const auto bytes = static_cast<std::size_t>(entry.bits / 8);
    if (entry.bits % 8 != 0 || at + bytes > frame.length) break;  // granularity is 8 bit (facts canopen 1.5)
    fields.push_back(decode_field(pdo, entry.object, &frame.data[at], bytes));
    at += bytes;
  }
  return fields;
}

DecodedField FrameDecoder::decode_field(const PdoTable& pdo, canopen::ObjectId object,
                                        const std::uint8_t* bytes, std::size_t count) const {
  const ObjectValue value = object_value(find(pdo.bus, pdo.node, object), object, bytes, count);
  DecodedField field{object, object_name(pdo.bus, pdo.node, object), value, {}};
  const NodeDescription* node = description_.find(pdo.bus, pdo.node);
  if (node != nullptr && node->actuator && value.number)
    field.joint = in_joint_units(*node->actuator, object, value.unit, as_double(value));
  return field;
}

void FrameDecoder::decode_sdo(const ObservedFrame& observed, bool reply, DecodedFrame& out) {
  out.kind = reply ? FrameKind::kSdoReply : FrameKind::kSdoRequest;
  const int node = static_cast<int>(observed.frame.id & kNodeMask);
  set_node(observed, node, out);
  SdoFollower& follower = sdos_[{observed.bus, node}];
  const SdoEvent event = reply ? follower.reply(observed.frame) : follower.request(observed.frame);
  std::string value;
  if (event.known && !event.bytes.empty()) {
    DecodedField field{event.object,
                       object_name(observed.bus, node, event.object),
                       object_value(find(observed.bus, node, event.object), event.object, event.bytes.data(),
                                    event.bytes.size()),
                       {}};
    value = with_unit(field.value);
    const bool whole = event.complete || event.kind == canopen::SdoKind::kDownload;
    if (whole) out.fields.push_back(std::move(field));
  }
  out.text = sdo_text(event, reply, event.known ? object_text(observed.bus, node, event.object) : "", value);
  if (event.complete && event.bytes.size() <= 4) {
    pdos_.learn(observed.bus, node, event.object,
                static_cast<std::uint32_t>(number_of(event.bytes.data(), event.bytes.size(), false)));
  }
}

void FrameDecoder::decode_heartbeat(const ObservedFrame& observed, DecodedFrame& out) {
  out.kind = FrameKind::kHeartbeat;
  const CanFrame& frame = observed.frame;
  const int node = static_cast<int>(frame.id & kNodeMask);
  set_node(observed, node, out);
  bool& guarded = guarded_[{observed.bus, node}];
  if (frame.remote) {
    guarded = true;
    out.text = "guarding: state?";
    return;
  }
  const canopen::GuardReply reply = canopen::decode_guard_reply(frame);
  if (reply.state == canopen::NmtState::kUnknown) {
    out.text = "not understood: " + bytes_text(frame);
  } else if (reply.state == canopen::NmtState::kBootUp && !guarded) {
    out.text = "boot-up";
    pdos_.restore(observed.bus, node);
  } else {
    out.text = (guarded ? "guarding: " : "") + std::string(canopen::nmt_text(reply.state)) +
               (guarded || reply.toggle ? (reply.toggle ? ", toggle 1" : ", toggle 0") : "");
  }
  guarded = false;
}

}  // namespace sprung::cantools
