#include "tools/logs/log/json_message.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

using Json = nlohmann::json;

class JsonMessageTest : public testing::Test {
 protected:
  std::string text_of(const std::string& bytes) {
    EXPECT_EQ(decoder_.open(bytes.data(), bytes.size(), message_), fields::Fault::kNone);
    std::string out;
    messages_.append(message_, out);
    return out;
  }
  fields::Decoder decoder_;
  fields::MessageView message_;
  JsonMessages messages_;
};

TEST_F(JsonMessageTest, IsNestedAsTheTypeIs) {
  const Json json = Json::parse(text_of(joint_event(125).data));
  EXPECT_EQ(json["seq"], 125);
  EXPECT_EQ(json["n_joints"], 2);
  ASSERT_EQ(json["joints"].size(), 2u);
  EXPECT_EQ(json["joints"][0]["gear_output_torque_Nm"], 1.25);
  EXPECT_EQ(json["joints"][1]["gear_output_torque_Nm"], 2.25);
  EXPECT_EQ(json["joints"][1]["at_rest"], false);
  EXPECT_EQ(json["body"]["estimated_quaternion_wxyz"].size(), 4u);
}

TEST_F(JsonMessageTest, WhatIsNotFiniteIsNull) {
  const Json json = Json::parse(text_of(joint_event(9).data));
  EXPECT_TRUE(json["joints"][1]["gear_output_torque_Nm"].is_null());
  EXPECT_EQ(json["joints"][0]["gear_output_torque_Nm"], 0.09);
}

TEST_F(JsonMessageTest, TextsAreEscaped) {
  EXPECT_EQ(Json::parse(text_of(motion_event(0, "say \"no\"\n\\ \xC3\xA4").data))["state_name"],
            "say \"no\"\n\\ \xC3\xA4");
  EXPECT_NO_THROW(Json::parse(text_of(motion_event(0, "\xFF\xFE broken UTF-8").data)));
}

TEST_F(JsonMessageTest, EveryShapeHasItsOwnFrame) {
  auto one = stamped<sprung_msgs::joint_state_t>(3);
  one.n_joints = 1;
  one.joints.resize(1);
  EXPECT_EQ(Json::parse(text_of(joint_event(1).data))["joints"].size(), 2u);
  EXPECT_EQ(Json::parse(text_of(encoded(one)))["joints"].size(), 1u);
  EXPECT_EQ(Json::parse(text_of(joint_event(2).data))["joints"].size(), 2u);
  EXPECT_FALSE(Json::parse(text_of(encoded(stamped<sprung_msgs::joint_state_t>(4)))).contains("joints"));
}

/// Every type of the stack, as empty as it can be.
TEST_F(JsonMessageTest, EveryTypesSchemaIsAnObjectWithItsMembers) {
  const auto& types = fields::TypeTable::sprung().all();
  ASSERT_GT(types.size(), 10u);
  for (const fields::StructType& type : types) {
    const Json schema = Json::parse(json_schema(type));
    EXPECT_EQ(schema["title"], type.name);
    EXPECT_EQ(schema["type"], "object");
    EXPECT_EQ(schema["properties"].size(), type.members.size()) << type.name;
  }
}

TEST_F(JsonMessageTest, SchemaTellsListsTruthsAndUnits) {
  const Json schema = Json::parse(json_schema(*fields::TypeTable::sprung().by_name("joint_state_t")));
  const Json joints = schema["properties"]["joints"];
  EXPECT_EQ(joints["type"], "array");
  const Json torque = joints["items"]["properties"]["gear_output_torque_Nm"];
  EXPECT_EQ(torque["type"], "number");
  EXPECT_EQ(torque["description"].get<std::string>().substr(0, 3), "Nm;");
  EXPECT_EQ(joints["items"]["properties"]["at_rest"]["type"], "boolean");
  EXPECT_EQ(schema["properties"]["seq"]["type"], "integer");
  const Json motion = Json::parse(json_schema(*fields::TypeTable::sprung().by_name("motion_state_t")));
  EXPECT_EQ(motion["properties"]["state_name"]["type"], "string");
}

/// What a message says must be of the type that the schema says.
TEST_F(JsonMessageTest, MessagesKeepTheirSchema) {
  const std::function<void(const Json&, const Json&, const std::string&)> check =
      [&](const Json& value, const Json& schema, const std::string& where) {
        const std::string type = schema["type"];
        if (type == "object") {
          ASSERT_TRUE(value.is_object()) << where;
          for (const auto& [key, member] : value.items()) {
            ASSERT_TRUE(schema["properties"].contains(key)) << where << "." << key;
            check(member, schema["properties"][key], where + "." + key);
          }
        } else if (type == "array") {
          ASSERT_TRUE(value.is_array()) << where;
          for (const Json& element : value) check(element, schema["items"], where + "[]");
        } else {
          const bool good = type == "boolean"   ? value.is_boolean()
                            : type == "string"  ? value.is_string()
                            : type == "integer" ? value.is_number_integer()
                                                : value.is_number() || value.is_null();
          EXPECT_TRUE(good) << where << " is " << value << ", not " << type;
        }
      };
  for (const Kept& event : robot_events(12)) {
    const Json value = Json::parse(text_of(event.data));
    check(value, Json::parse(json_schema(*message_.layout()->type)), event.channel);
  }
}

}  // namespace
}  // namespace sprung::log
