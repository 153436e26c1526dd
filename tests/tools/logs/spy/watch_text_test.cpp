#include "tools/logs/spy/watch_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/tools/logs/spy/sample_messages.h"

namespace sprung::spy {
namespace {

class WatchText : public testing::Test {
 protected:
  std::vector<const fields::Field*> open(const std::vector<std::uint8_t>& bytes, const std::string& pattern) {
    bytes_ = bytes;
    EXPECT_EQ(decoder_.open(bytes_.data(), bytes_.size(), view_), fields::Fault::kNone);
    return fields::choose(*view_.layout(), {pattern}, names_);
  }
  const std::vector<fields::ListNames> names_{{"joints", {"hip", "knee"}}};
  fields::Decoder decoder_;
  fields::MessageView view_;
  std::vector<std::uint8_t> bytes_;
};

TEST_F(WatchText, TargetsAreChannelAndPattern) {
  EXPECT_EQ(parse_target("JOINT_STATE").channel, "JOINT_STATE");
  EXPECT_EQ(parse_target("JOINT_STATE").pattern, "");
  EXPECT_EQ(parse_target("JOINT_STATE.joints[1].status").channel, "JOINT_STATE");
  EXPECT_EQ(parse_target("JOINT_STATE.joints[1].status").pattern, "joints[1].status");
  EXPECT_EQ(parse_target("JOINT_STATE.").pattern, "");
}

/// Such a name would be taken for a regular expression, and name other channels.
TEST_F(WatchText, PatternsOfChannelsAreNotMeant) {
  for (const char* text :
       {"*", ".*", "", ".field", "*_STATE.joints", "A|B", "JOINT_STAT?", "[A-Z]", "(A", "A+", "A$"})
    EXPECT_THROW(parse_target(text), std::invalid_argument) << text;
  EXPECT_EQ(parse_target("my/channel-2.x[*]").channel, "my/channel-2");
}

TEST_F(WatchText, OneFieldIsOneLine) {
  const auto chosen = open(test::joint_state_bytes(5, 12.5), "joints[knee].gear_output_torque_Nm");
  EXPECT_EQ(watch_text("JOINT_STATE", view_, chosen, names_),
            "0.010000 s  cycle 5  joints[knee].gear_output_torque_Nm  12.5 Nm");
}

TEST_F(WatchText, ManyFieldsAreALineEach) {
  const auto chosen = open(test::encoded(test::motion_state(5, 3)), "*");
  const std::string text = watch_text("MOTION_STATE", view_, chosen, names_);
  EXPECT_THAT(text, testing::StartsWith("MOTION_STATE  0.010000 s  cycle 5\n  session  "));
  EXPECT_THAT(text, testing::ContainsRegex("\n  legs.0..phase  +thrust .3.\n"));
}

TEST_F(WatchText, JsonKeepsKindsAndWritesNullForWhatIsNoNumber) {
  auto message = test::motion_state(5, 3);
  message.gait_phase = std::nan("");
  message.jump_height_scale = 0.1;
  const auto chosen = open(test::encoded(message), "*");
  const auto json = watch_json("MOTION_STATE", view_, chosen);
  EXPECT_EQ(json["channel"], "MOTION_STATE");
  EXPECT_EQ(json["utime"], 10'000);
  EXPECT_EQ(json["seq"], 5);
  EXPECT_EQ(json["fields"]["legs[0].phase"], 3);
  EXPECT_EQ(json["fields"]["state_name"], "thrust");
  EXPECT_EQ(json["fields"]["jump_height_scale"], 0.1);
  EXPECT_TRUE(json["fields"]["gait_phase"].is_null());
}

TEST_F(WatchText, TruthsAreTruths) {
  const auto chosen = open(test::joint_state_bytes(0, 0), "legs[0].contact");
  EXPECT_EQ(watch_json("JOINT_STATE", view_, chosen)["fields"]["legs[0].contact"], false);
}

}  // namespace
}  // namespace sprung::spy
