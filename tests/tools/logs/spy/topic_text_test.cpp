#include "tools/logs/spy/topic_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/logs/spy/sample_messages.h"

namespace sprung::spy {
namespace {

class TopicText : public testing::Test {
 protected:
  const Channel& channel_of(const char* name, const std::vector<std::uint8_t>& bytes, int count = 1) {
    for (int i = 0; i < count; ++i) book_.add(now_us_ += 10'000, name, bytes.data(), bytes.size());
    return *book_.find(name);
  }
  ChannelBook book_;
  std::int64_t now_us_ = 0;
};

TEST_F(TopicText, ALineStandsUnderItsHeading) {
  const Channel& channel = channel_of("MOTION_STATE", test::encoded(test::motion_state(4, 1)), 11);
  const std::string line = topic_line("MOTION_STATE", channel, now_us_ + 3000);
  EXPECT_THAT(line, testing::HasSubstr("MOTION_STATE      motion_state_t         100.0"));
  EXPECT_THAT(line, testing::HasSubstr("3 ms"));
  EXPECT_EQ(line.size(), topic_heading().size());
}

TEST_F(TopicText, WhatIsBrokenOrUnknownIsSaid) {
  EXPECT_THAT(topic_line("X", channel_of("X", {1, 2, 3, 4, 5, 6, 7, 8, 9}), 0),
              testing::HasSubstr("unknown type"));
  auto bytes = test::joint_state_bytes(1, 0);
  channel_of("Y", bytes);
  bytes.push_back(0);
  EXPECT_THAT(topic_line("Y", channel_of("Y", bytes), 0),
              testing::HasSubstr("joint_state_t: trailing bytes"));
}

TEST_F(TopicText, JsonHasNullWhereNothingIsKnown) {
  const auto known = topic_json("JOINT_STATE", channel_of("JOINT_STATE", test::joint_state_bytes(6, 0), 2),
                                now_us_);
  EXPECT_EQ(known["type"], "joint_state_t");
  EXPECT_EQ(known["seq"], 6);
  EXPECT_EQ(known["missing"], 0);
  EXPECT_DOUBLE_EQ(known["rate_hz"], 100.0);
  const auto unknown = topic_json("X", channel_of("X", {1, 2, 3, 4, 5, 6, 7, 8}), now_us_);
  EXPECT_TRUE(unknown["type"].is_null());
  EXPECT_TRUE(unknown["seq"].is_null());
  EXPECT_TRUE(unknown["missing"].is_null());
}

TEST_F(TopicText, AgesAreInTheUnitThatFits) {
  EXPECT_EQ(age_text(1'400), "1 ms");
  EXPECT_EQ(age_text(3'520'000), "3.5 s");
  EXPECT_EQ(age_text(126'000'000), "2 min");
}

}  // namespace
}  // namespace sprung::spy
