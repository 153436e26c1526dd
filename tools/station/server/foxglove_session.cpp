#include "tools/station/server/foxglove_session.h"

#include <nlohmann/json.hpp>

#include "tools/logs/log/proto_schema.h"
#include "tools/logs/log/proto_types.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

constexpr const char* kTransformSchema =
    R"({"title":"foxglove.FrameTransforms","type":"object","properties":{)"
    R"("transforms":{"type":"array","items":{"title":"foxglove.FrameTransform","type":"object","properties":{)"
    R"("timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("parent_frame_id":{"type":"string"},"child_frame_id":{"type":"string"},)"
    R"("translation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},)"
    R"("rotation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"},)"
    R"("w":{"type":"number"}}}}}}}})";

std::string base64(std::string_view bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t triple = 0;
    for (std::size_t j = 0; j < 3; ++j)
      triple = triple << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (unsigned j = 0; j < 4; ++j)
      out += i + j > bytes.size() ? '=' : kLetters[triple >> (18U - 6U * j) & 63U];
  }
  return out;
}

template <class Number>
void append(Number number, std::string& out) {
  for (std::size_t i = 0; i < sizeof number; ++i) out += static_cast<char>(number >> (8 * i) & 0xFFU);
}

std::string status(const std::string& what) {
  return Json({{"op", "status"}, {"level", 2}, {"message", what}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json transform_channel(std::size_t id) {
  return {{"id", id},
          {"topic", kTransformTopic},
          {"encoding", "json"},
          {"schemaName", "foxglove.FrameTransforms"},
          {"schema", kTransformSchema},
          {"schemaEncoding", "jsonschema"}};
}

}  // namespace

FoxgloveSession::FoxgloveSession(std::string name,
                                 const std::vector<std::pair<std::string, std::string>>& channels)
    : name_(std::move(name)), channels_(channels) {
  channels_.emplace_back(kTransformTopic, "");
}

std::vector<std::string> FoxgloveSession::opened(int viewer) {
  viewers_[viewer];
  const Json info{{"op", "serverInfo"},
                  {"name", name_},
                  {"capabilities", Json::array()},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()}};
  Json advertised = Json::array();
  for (std::size_t id = 0; id + 1 < channels_.size(); ++id) {
    const fields::StructType& type = *fields::TypeTable::sprung().by_name(channels_[id].second);
    advertised.push_back({{"id", id},
                          {"topic", channels_[id].first},
                          {"encoding", "protobuf"},
                          {"schemaName", log::proto_name(type)},
                          {"schema", base64(log::proto_schema(type))},
                          {"schemaEncoding", "protobuf"}});
  }
  advertised.push_back(transform_channel(channels_.size() - 1));
  return {info.dump(), Json({{"op", "advertise"}, {"channels", advertised}}).dump()};
}

std::string FoxgloveSession::text(int viewer, std::string_view text) {
  try {
    const Json message = Json::parse(text);
    const std::string op = message.at("op").get<std::string>();
    if (op == "subscribe") {
      subscribe(viewer, message);
    } else if (op == "unsubscribe") {
      unsubscribe(viewer, message);
    } else {
      return status("this server only shows: '" + op.substr(0, 40) + "' is not done");
    }
  } catch (const std::exception& error) {
    return status(std::string(error.what()).substr(0, 200));
  }
  return "";
}

void FoxgloveSession::subscribe(int viewer, const Json& message) {
  auto& subscriptions = viewers_.at(viewer);
  for (const Json& each : message.at("subscriptions")) {
    const auto channel = each.at("channelId").get<std::uint32_t>();
    if (channel >= channels_.size())
      throw std::invalid_argument("there is no channel " + std::to_string(channel));
    if (subscriptions.size() >= kMostSubscriptions) throw std::invalid_argument("too many subscriptions");
    subscriptions[each.at("id").get<std::uint32_t>()] = channel;
  }
}

void FoxgloveSession::unsubscribe(int viewer, const Json& message) {
  for (const Json& each : message.at("subscriptionIds")) viewers_.at(viewer).erase(each.get<std::uint32_t>());
}

bool FoxgloveSession::wanted(const std::string& topic) const {
  for (const auto& [viewer, subscriptions] : viewers_)
    for (const auto& [id, channel] : subscriptions)
      if (channels_[channel].first == topic) return true;
  return false;
}

FoxgloveSession::Messages FoxgloveSession::message(const std::string& channel, const std::uint8_t* data,
                                                   std::size_t size, std::int64_t time_ns) {
  if (!wanted(channel) || decoder_.open(data, size, view_) != fields::Fault::kNone) return {};
  return to_subscribers(channel, protos_.encode(view_, data, size), time_ns);
}

/// "Message data": opcode 1, subscription, time, payload; little endian.
FoxgloveSession::Messages FoxgloveSession::to_subscribers(const std::string& topic, std::string_view payload,
                                                          std::int64_t time_ns) const {
  Messages out;
  for (const auto& [viewer, subscriptions] : viewers_) {
    for (const auto& [id, channel] : subscriptions) {
      if (channels_[channel].first != topic) continue;
      std::string bytes(1, '\x01');
      append(id, bytes);
      append(static_cast<std::uint64_t>(time_ns), bytes);
      bytes += payload;
      out.emplace_back(viewer, std::move(bytes));
    }
  }
  return out;
}

}  // namespace sprung::station
