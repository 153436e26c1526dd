#include "tools/can/decode/frame_line.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace sprung::cantools {
namespace {

using Json = nlohmann::ordered_json;

const char* arrow(Direction direction) {
  if (direction == Direction::kSent) return "->";
  return direction == Direction::kReceived ? "<-" : "  ";
}

const char* direction_name(Direction direction) {
  if (direction == Direction::kSent) return "sent";
  return direction == Direction::kReceived ? "received" : "unknown";
}

std::string hex_text(const std::uint8_t* bytes, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    char pair[4];
    std::snprintf(pair, sizeof pair, "%02X", bytes[i]);
    text += pair;
  }
  return text;
}

std::string data_text(const CanFrame& frame) {
  return frame.remote ? "" : hex_text(frame.data.data(), frame.length);
}

Json field_json(const DecodedField& field) {
  Json out{{"object", canopen::id_text(field.object)},
           {"name", field.name},
           {"value", number_json(field.value)},
           {"text", field.value.text},
           {"unit", field.value.unit}};
  for (const JointValue& value : field.joint) out["joint"][value.unit] = value.value;
  return out;
}

}  // namespace

Json number_json(const ObjectValue& value) {
  if (!value.number) return nullptr;
  if (value.is_wide) return static_cast<std::uint64_t>(*value.number);
  return *value.number;
}

std::string frame_line(const ObservedFrame& observed, const DecodedFrame& decoded, const std::string& bus,
                       std::int64_t begin_us) {
  char head[96];
  std::snprintf(head, sizeof head, "%13.6f %-6s %s %03X %-11s ",
                static_cast<double>(observed.time_us - begin_us) * 1e-6, bus.c_str(),
                arrow(observed.direction), static_cast<unsigned>(observed.frame.id), name(decoded.kind));
  const bool pdo = decoded.kind == FrameKind::kTpdo || decoded.kind == FrameKind::kRpdo;
  std::string line = head + decoded.node_name;
  if (!decoded.text.empty()) line += (decoded.node_name.empty() ? "" : pdo ? " " : ": ") + decoded.text;
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

Json frame_json(const ObservedFrame& observed, const DecodedFrame& decoded, const std::string& bus,
                std::int64_t begin_us) {
  Json out{{"time_us", observed.time_us - begin_us},
           {"bus", bus},
           {"direction", direction_name(observed.direction)},
           {"id", observed.frame.id},
           {"data", data_text(observed.frame)},
           {"kind", name(decoded.kind)},
           {"node", nullptr},
           {"name", decoded.node_name},
           {"text", decoded.text},
           {"fields", Json::array()}};
  if (decoded.node >= 0) out["node"] = decoded.node;
  for (const DecodedField& field : decoded.fields) out["fields"].push_back(field_json(field));
  return out;
}

std::string fd_frame_line(const ObservedFdFrame& observed, const std::string& bus, std::int64_t begin_us) {
  const CanFdFrame& frame = observed.frame;
  char head[96];
  std::snprintf(head, sizeof head,
                frame.extended ? "%13.6f %-6s    %08X CAN FD [%d]" : "%13.6f %-6s    %03X CAN FD [%d]",
                static_cast<double>(observed.time_us - begin_us) * 1e-6, bus.c_str(),
                static_cast<unsigned>(frame.id), frame.length);
  return std::string(head) + (frame.fast ? " BRS" : "") + (frame.passive ? " ESI" : "") +
         (frame.length == 0 ? "" : " " + hex_text(frame.data.data(), frame.length));
}

Json fd_frame_json(const ObservedFdFrame& observed, const std::string& bus, std::int64_t begin_us) {
  const CanFdFrame& frame = observed.frame;
  return {{"time_us", observed.time_us - begin_us},
          {"bus", bus},
          {"id", frame.id},
          {"extended", frame.extended},
          {"data", hex_text(frame.data.data(), frame.length)},
          {"kind", "CAN FD"},
          {"bit_rate_switch", frame.fast},
          {"error_passive", frame.passive}};
}

}  // namespace sprung::cantools
