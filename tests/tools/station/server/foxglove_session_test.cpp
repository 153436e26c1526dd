#include "tools/station/server/foxglove_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sprung_msgs/safety_state_t.hpp"

namespace sprung::station {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Foxglove : public testing::Test {
 protected:
  static std::vector<std::uint8_t> safety() {
    sprung_msgs::safety_state_t message{};
    message.seq = 7;
    message.level_name = "damping";
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }
  FoxgloveSession session_{
      "pegasus", {{"JOINT_STATE", "joint_state_t"}, {"SAFETY_STATE", "safety_state_t"}}, "shapes"};
};

TEST_F(Foxglove, AViewerIsToldWhoWeAreAndWhatThereIs) {
  const auto told = session_.opened(1);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(Json::parse(told[0])["op"], "serverInfo");
  const Json advertised = Json::parse(told[1]);
  ASSERT_EQ(advertised["channels"].size(), 2 + kRobotTopics.size());
  EXPECT_EQ(advertised["channels"][1]["schemaName"], "sprung_msgs.safety_state_t");
  EXPECT_EQ(advertised["channels"][1]["schema"].get<std::string>().size() % 4, 0u);
  std::vector<std::string> topics;
  for (const Json& channel : advertised["channels"]) {
    topics.push_back(channel["topic"]);
    EXPECT_EQ(channel["encoding"], "protobuf");
    EXPECT_EQ(channel["schemaEncoding"], "protobuf");
    EXPECT_FALSE(channel["schema"].get<std::string>().empty()) << channel["topic"];
  }
  EXPECT_THAT(topics, testing::ElementsAre("JOINT_STATE", "SAFETY_STATE", "/tf", "/robot", "/forces",
                                           "/joint_states", "/wrenches", "/imu"));
}

TEST_F(Foxglove, ARobotThatCannotBeDrawnHasItsChannelsAlone) {
  FoxgloveSession session("pegasus", {{"JOINT_STATE", "joint_state_t"}}, "");
  EXPECT_EQ(Json::parse(session.opened(1)[1])["channels"].size(), 1u);
}

TEST_F(Foxglove, WhoSubscribedGetsTheMessageInProtocolBuffers) {
  session_.opened(1);
  const auto bytes = safety();
  EXPECT_TRUE(session_.message("SAFETY_STATE", bytes.data(), bytes.size(), 5).empty());
  EXPECT_EQ(session_.text(1, R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":1}]})"), "");
  const auto sent = session_.message("SAFETY_STATE", bytes.data(), bytes.size(), 0x0102);
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].first, 1);
  EXPECT_EQ(sent[0].second.substr(0, 13), std::string("\x01\x09\0\0\0\x02\x01\0\0\0\0\0\0", 13));
  EXPECT_THAT(sent[0].second, HasSubstr("damping"));
  EXPECT_EQ(session_.text(1, R"({"op":"unsubscribe","subscriptionIds":[9]})"), "");
  EXPECT_TRUE(session_.message("SAFETY_STATE", bytes.data(), bytes.size(), 5).empty());
}

TEST_F(Foxglove, WhatAViewerMayNotDoOrCannotMeanIsAStatus) {
  session_.opened(1);
  for (const char* text : {"{", "[]", R"({"op":7})", R"({"op":"advertise","channels":[]})",
                           R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":99}]})",
                           R"({"op":"subscribe","subscriptions":[{"id":-1}]})", R"({"op":"setParameters"})"})
    EXPECT_THAT(session_.text(1, text), HasSubstr("\"status\"")) << text;
}

TEST_F(Foxglove, AViewerThatAsksForEverythingForEverIsBounded) {
  session_.opened(1);
  std::string last;
  for (int id = 0; id <= static_cast<int>(FoxgloveSession::kMostSubscriptions); ++id)
    last = session_.text(
        1, R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) + R"(,"channelId":0}]})");
  EXPECT_THAT(last, HasSubstr("too many"));
}

TEST_F(Foxglove, WhatTheRobotLooksLikeGoesToItsTopics) {
  session_.opened(1);
  session_.text(1, R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":2}]})");
  EXPECT_TRUE(session_.wanted("/tf"));
  EXPECT_FALSE(session_.wanted("/forces"));
  EXPECT_EQ(session_.robot_message(RobotTopic::kTransforms, "moved", 1).at(0).second.substr(13), "moved");
  EXPECT_TRUE(session_.robot_message(RobotTopic::kForces, "pushed", 1).empty());
  EXPECT_TRUE(session_.robot_message(RobotTopic::kTransforms, "", 1).empty()) << "there is nothing to tell";
  session_.closed(1);
  EXPECT_FALSE(session_.wanted("/tf"));
}

TEST_F(Foxglove, WhoeverSubscribesToShapesGetsThemOnceAndAtOnce) {
  session_.opened(1);
  session_.text(1, R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":2},{"id":4,"channelId":3}]})");
  const auto sent = session_.take_shapes(1);
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].first, 1);
  EXPECT_EQ(sent[0].second.substr(0, 5), std::string("\x01\x04\0\0\0", 5));
  EXPECT_EQ(sent[0].second.substr(13), "shapes");
  EXPECT_TRUE(session_.take_shapes(1).empty());
  session_.opened(2);
  session_.text(2, R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":3}]})");
  session_.closed(2);
  EXPECT_TRUE(session_.take_shapes(1).empty()) << "it has gone";
}

}  // namespace
}  // namespace sprung::station
