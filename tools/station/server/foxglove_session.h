#pragma once
/// The robot for Foxglove and whatever speaks its WebSocket protocol (subprotocols foxglove.sdk.v1 and
/// foxglove.websocket.v1; github.com/foxglove/ws-protocol): channels with the schemas that `sprung log mcap`
/// writes, and the topics beside them that let the robot stand in 3-D panels (robot_messages.h). It only
/// shows: nothing that a viewer says reaches the robot. Pure.
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/proto_message.h"
#include "tools/station/foxglove/robot_messages.h"

namespace sprung::station {

class FoxgloveSession {
 public:
  static constexpr std::size_t kMostSubscriptions = 64;  ///< of one viewer

  /// @param channels of the network, each with the name of its type: {"JOINT_STATE", "joint_state_t"}.
  /// @param shapes of the robot, RobotMessages::shapes(): told to whoever subscribes to them, at once. "": it
  /// cannot be drawn, and has none of kRobotTopics.
  FoxgloveSession(std::string name, const std::vector<std::pair<std::string, std::string>>& channels,
                  const std::string& shapes);

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
  /// @param payload "": there is nothing to tell.
  Messages robot_message(RobotTopic topic, const std::string& payload, std::int64_t time_ns) const;
  /// To whoever has subscribed to them since the last call.
  Messages take_shapes(std::int64_t time_ns);

 private:
  void subscribe(int viewer, const nlohmann::json& message);
  void unsubscribe(int viewer, const nlohmann::json& message);
  Messages to_subscribers(const std::string& topic, std::string_view payload, std::int64_t time_ns) const;

  std::string name_;
  std::string shapes_;
  std::vector<std::string> topics_;                                ///< the index is the channel's id
  std::string advertisement_;                                      ///< of all channels
  std::map<int, std::map<std::uint32_t, std::uint32_t>> viewers_;  ///< subscription to channel
  std::vector<std::pair<int, std::uint32_t>> awaiting_shapes_;     ///< viewer and subscription
  fields::Decoder decoder_;
  fields::MessageView view_;
  log::ProtoMessages protos_;
};

}  // namespace sprung::station
