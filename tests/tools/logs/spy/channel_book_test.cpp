#include "tools/logs/spy/channel_book.h"

#include <gtest/gtest.h>

#include "tests/tools/logs/spy/sample_messages.h"

namespace sprung::spy {
namespace {

class ChannelBookTest : public testing::Test {
 protected:
  void add(const char* channel, const std::vector<std::uint8_t>& bytes) {
    book_.add(now_us_ += 20'000, channel, bytes.data(), bytes.size());
  }
  ChannelBook book_;
  std::int64_t now_us_ = 0;
};

TEST_F(ChannelBookTest, KnowsTypeStampAndLastMessage) {
  add("JOINT_STATE", test::joint_state_bytes(7, 1.0));
  add("JOINT_STATE", test::joint_state_bytes(8, 2.5));
  const Channel* channel = book_.find("JOINT_STATE");
  ASSERT_NE(channel, nullptr);
  EXPECT_EQ(channel->type, "joint_state_t");
  EXPECT_EQ(channel->stamp->seq, 8);
  EXPECT_EQ(channel->statistics.figures(now_us_).messages, 2);
  fields::MessageView message;
  ASSERT_TRUE(book_.open_last(*channel, message));
  EXPECT_EQ(message.number(message.fields()[message.layout()->find("joints[1].gear_output_torque_Nm")]), 2.5);
}

TEST_F(ChannelBookTest, CountsMissingCyclesWhereEachHasAMessage) {
  for (const int seq : {0, 1, 4, 5}) {
    add("JOINT_STATE", test::joint_state_bytes(seq, 0));
    add("MY_STATE", test::joint_state_bytes(seq, 0));
  }
  EXPECT_TRUE(book_.find("JOINT_STATE")->has_every_cycle);
  EXPECT_EQ(book_.find("JOINT_STATE")->gaps.counts().missing, 2);
  EXPECT_FALSE(book_.find("MY_STATE")->has_every_cycle);
}

TEST_F(ChannelBookTest, TellsBrokenMessagesFromUnknownOnes) {
  auto bytes = test::joint_state_bytes(1, 0);
  add("A", bytes);
  bytes.pop_back();
  add("A", bytes);
  EXPECT_EQ(book_.find("A")->fault, fields::Fault::kTooShort);
  EXPECT_EQ(book_.find("A")->malformed, 1);
  EXPECT_EQ(book_.find("A")->type, "joint_state_t");
  add("B", {1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(book_.find("B")->fault, fields::Fault::kUnknownType);
  EXPECT_EQ(book_.find("B")->malformed, 0);
  fields::MessageView message;
  EXPECT_FALSE(book_.open_last(*book_.find("B"), message));
  EXPECT_EQ(book_.find("C"), nullptr);
}

TEST_F(ChannelBookTest, KeepsTheHistoryOfTheOneThatIsFollowed) {
  book_.follow("JOINT_STATE");
  for (int i = 0; i < 3; ++i) {
    add("JOINT_STATE", test::joint_state_bytes(i, i));
    add("OTHER", test::joint_state_bytes(i, 100 + i));
  }
  const std::size_t seq = 2;
  EXPECT_EQ(book_.history().of(seq), (std::vector<double>{0, 1, 2}));
  book_.follow("JOINT_STATE");
  EXPECT_EQ(book_.history().of(seq).size(), 3u);
  book_.follow("OTHER");
  EXPECT_TRUE(book_.history().of(seq).empty());
}

}  // namespace
}  // namespace sprung::spy
