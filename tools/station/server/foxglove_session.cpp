#include "tools/station/server/foxglove_session.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "tools/logs/log/proto_schema.h"
#include "tools/logs/log/proto_types.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

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

/// "Message data": opcode 1, subscription, time, payload; little endian.
std::string message_data(std::uint32_t subscription, std::string_view payload, std::int64_t time_ns) {
  std::string bytes(1, '\x01');
  append(subscription, bytes);
  append(static_cast<std::uint64_t>(time_ns), bytes);
  return bytes.append(payload);
}

Json channel_json(std::size_t id, const std::string& topic, const std::string& type,
                  const std::string& schema) {
  return {{"id", id},           {"topic", topic},           {"encoding", "protobuf"},
          {"schemaName", type}, {"schema", base64(schema)}, {"schemaEncoding", "protobuf"}};
}

}  // namespace

FoxgloveSession::FoxgloveSession(std::string name,
                                 const std::vector<std::pair<std::string, std::string>>& channels,
                                 const std::string& shapes)
    : name_(std::move(name)), shapes_(shapes) {
  Json advertised = Json::array();
  for (const auto& [topic, type_name] : channels) {
    const fields::StructType& type = *fields::TypeTable::sprung().by_name(type_name);
    advertised.push_back(channel_json(topics_.size(), topic, log::proto_name(type), log::proto_schema(type)));
    topics_.push_back(topic);
  }
  for (const RobotTopic topic : kRobotTopics) {
    if (shapes_.empty()) break;
    const std::string type = type_of(topic);
    advertised.push_back(channel_json(topics_.size(), name_of(topic), type, foxglove_schema(type)));
    topics_.push_back(name_of(topic));
  }
  advertisement_ = Json({{"op", "advertise"}, {"channels", std::move(advertised)}}).dump();
}

std::vector<std::string> FoxgloveSession::opened(int viewer) {
  viewers_[viewer];
  const Json info{{"op", "serverInfo"},
                  {"name", name_},
                  {"capabilities", Json::array()},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()}};
  return {info.dump(), advertisement_};
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
    if (channel >= topics_.size())
      throw std::invalid_argument("there is no channel " + std::to_string(channel));
    if (subscriptions.size() >= kMostSubscriptions) throw std::invalid_argument("too many subscriptions");
    const auto id = each.at("id").get<std::uint32_t>();
    subscriptions[id] = channel;
    if (topics_[channel] == name_of(RobotTopic::kShapes)) awaiting_shapes_.emplace_back(viewer, id);
  }
}

void FoxgloveSession::unsubscribe(int viewer, const Json& message) {
  for (const Json& each : message.at("subscriptionIds")) viewers_.at(viewer).erase(each.get<std::uint32_t>());
}

bool FoxgloveSession::wanted(const std::string& topic) const {
  for (const auto& [viewer, subscriptions] : viewers_)
    for (const auto& [id, channel] : subscriptions)
      if (topics_[channel] == topic) return true;
  return false;
}

FoxgloveSession::Messages FoxgloveSession::message(const std::string& channel, const std::uint8_t* data,
                                                   std::size_t size, std::int64_t time_ns) {
  if (!wanted(channel) || decoder_.open(data, size, view_) != fields::Fault::kNone) return {};
  return to_subscribers(channel, protos_.encode(view_, data, size), time_ns);
}

FoxgloveSession::Messages FoxgloveSession::robot_message(RobotTopic topic, const std::string& payload,
                                                         std::int64_t time_ns) const {
  return payload.empty() ? Messages() : to_subscribers(name_of(topic), payload, time_ns);
}

FoxgloveSession::Messages FoxgloveSession::take_shapes(std::int64_t time_ns) {
  Messages out;
  for (const auto& [viewer, id] : std::exchange(awaiting_shapes_, {}))
    if (has(viewer)) out.emplace_back(viewer, message_data(id, shapes_, time_ns));
  return out;
}

FoxgloveSession::Messages FoxgloveSession::to_subscribers(const std::string& topic, std::string_view payload,
                                                          std::int64_t time_ns) const {
  Messages out;
  for (const auto& [viewer, subscriptions] : viewers_)
    for (const auto& [id, channel] : subscriptions)
      if (topics_[channel] == topic) out.emplace_back(viewer, message_data(id, payload, time_ns));
  return out;
}

}  // namespace sprung::station
