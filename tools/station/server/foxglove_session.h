#pragma once
/// The robot for Foxglove and whatever speaks its WebSocket protocol (subprotocols foxglove.sdk.v1 and
/// foxglove.websocket.v1; github.com/foxglove/ws-protocol): channels with the schemas that `sprung log mcap`
/// writes, and the robot's transforms. It only shows: nothing that a viewer says reaches the robot. Pure.
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/proto_message.h"

namespace sprung::station {

/// Topic of the transforms; its messages are foxglove.FrameTransforms in JSON.
inline constexpr const char* kTransformTopic = "/tf";

class FoxgloveSession {
 public:
  static constexpr std::size_t kMostSubscriptions = 64;  ///< of one viewer

  /// @param channels of the network, each with the name of its type: {"JOINT_STATE", "joint_state_t"}.
  FoxgloveSession(std::string name, const std::vector<std::pair<std::string, std::string>>& channels);

  /// What a viewer is told first: serverInfo and advertise.
  std::vector<std::string> opened(int viewer);
  void closed(int viewer) { viewers_.erase(viewer); }
  bool has(int viewer) const { return viewers_.count(viewer) != 0; }
  /// What it says. @return what it is told; "" = nothing.
  std::string text(int viewer, std::string_view text);

  bool wanted(const std::string& topic) const;
  using Messages = std::vector<std::pair<int, std::string>>;  ///< viewer and binary message
  /// A message of the network, to whoever subscribed; one that cannot be decoded to nobody.
  Messages message(const std::string& channel, const std::uint8_t* data, std::size_t size,
                   std::int64_t time_ns);
  Messages transforms(const std::string& json, std::int64_t time_ns) {
    return to_subscribers(kTransformTopic, json, time_ns);
  }

 private:
  void subscribe(int viewer, const nlohmann::json& message);
  void unsubscribe(int viewer, const nlohmann::json& message);
  Messages to_subscribers(const std::string& topic, std::string_view payload, std::int64_t time_ns) const;

  std::string name_;
  std::vector<std::pair<std::string, std::string>> channels_;      ///< topic and type; its index is its id
  std::map<int, std::map<std::uint32_t, std::uint32_t>> viewers_;  ///< subscription to channel
  fields::Decoder decoder_;
  fields::MessageView view_;
  log::ProtoMessages protos_;
};

}  // namespace sprung::station
