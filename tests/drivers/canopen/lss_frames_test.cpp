/// LssBytes of layer setting services, typed by hand from CiA 305: lss_frames.h.
#include "drivers/canopen/lss_frames.h"

#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

using LssBytes = std::array<std::uint8_t, 8>;

TEST(LssFrames, RequestsAreTheStandardsBytes) {
  EXPECT_EQ(lss_request(LssCommand::kSwitchAll, 1).data, (LssBytes{0x04, 1}));
  EXPECT_EQ(lss_request(LssCommand::kConfigureNode, 42).data, (LssBytes{0x11, 42}));
  EXPECT_EQ(lss_request(LssCommand::kConfigureBitRate, 0, 2).data, (LssBytes{0x13, 0, 2}));
  EXPECT_EQ(lss_select_request(3, 0x12345678).data, (LssBytes{0x43, 0x78, 0x56, 0x34, 0x12}));
  const CanFrame scan = lss_fastscan_request({0xFB, 31, 2, 3});
  EXPECT_EQ(scan.data, (LssBytes{0x51, 0xFB, 0, 0, 0, 31, 2, 3}));
  EXPECT_EQ(scan.id, 0x7E5u);
  EXPECT_EQ(scan.length, 8);
}

TEST(LssFrames, FastscanQuestionComesBack) {
  const LssQuestion question = decode_lss_question(lss_fastscan_request({0xDEADBEEF, 7, 1, 2}));
  EXPECT_EQ(question.number, 0xDEADBEEFu);
  EXPECT_EQ(question.bit, 7);
  EXPECT_EQ(question.part, 1);
  EXPECT_EQ(question.next, 2);
}

TEST(LssFrames, RepliesHaveTheSlavesIdentifier) {
  const CanFrame reply = lss_reply(LssCommand::kInquireSerial, 0x01020304);
  EXPECT_EQ(reply.id, 0x7E4u);
  EXPECT_EQ(reply.data, (LssBytes{0x5D, 4, 3, 2, 1}));
  EXPECT_TRUE(is_lss_reply(reply));
  EXPECT_FALSE(is_lss_request(reply));
}

TEST(LssFrames, ShortRemoteAndErrorFramesAreNone) {
  CanFrame frame = lss_request(LssCommand::kStore);
  ASSERT_TRUE(is_lss_request(frame));
  frame.length = 7;
  EXPECT_FALSE(is_lss_request(frame));
  frame.length = 8;
  frame.remote = true;
  EXPECT_FALSE(is_lss_request(frame));
  frame.remote = false;
  frame.error = true;
  EXPECT_FALSE(is_lss_request(frame));
}

TEST(LssFrames, BitRatesAreThoseOfTheTable) {
  EXPECT_EQ(lss_bit_rate_index(1000), 0);
  EXPECT_EQ(lss_bit_rate_index(500), 2);
  EXPECT_EQ(lss_bit_rate_index(10), 8);
  for (const int none : {0, 100, 999}) EXPECT_EQ(lss_bit_rate_index(none), -1) << none;
  EXPECT_EQ(lss_bit_rate_kbit_s(4), 125);
  for (const int none : {-1, 5, 9}) EXPECT_EQ(lss_bit_rate_kbit_s(none), 0) << none;
}

TEST(LssFrames, EveryCommandHasItsName) {
  EXPECT_STREQ(lss_text(LssCommand::kConfigureNode), "configure node id");
  EXPECT_STREQ(lss_text(static_cast<LssCommand>(0x42)), "select by identity");
  EXPECT_STREQ(lss_text(static_cast<LssCommand>(0x5C)), "inquire identity");
  EXPECT_STREQ(lss_text(static_cast<LssCommand>(0xFF)), "unknown command");
}

}  // namespace
}  // namespace sprung::canopen
