#include "runtime/transport/fragment_store.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/runtime/transport/datagrams.h"

namespace sprung {
namespace {

using test::Bytes;
using test::FragmentHead;
using test::with_channel;

constexpr DatagramSender kAnn{1, 100}, kBob{1, 200};

class FragmentStoreTest : public testing::Test {
 protected:
  /// Text of the message that became whole, "" where none did.
  std::string add(const DatagramSender& sender, const FragmentHead& head, const std::string& rest,
                  std::int64_t now_us = 0) {
    const Bytes bytes = test::fragment_datagram(head, rest);
    LcmPacket packet;
    EXPECT_EQ(parse_lcm_packet(bytes.data(), bytes.size(), packet), PacketFault::kNone);
    const FragmentStore::Message* const whole = store_.add(sender, packet, now_us);
    return whole == nullptr ? ""
                            : whole->channel + ":" + std::string(whole->bytes.begin(), whole->bytes.end());
  }
  FragmentStore store_;
};

TEST_F(FragmentStoreTest, PiecesBecomeAMessageInAnyOrder) {
  EXPECT_EQ(add(kAnn, {1, 6, 0, 0, 3}, with_channel("ab")), "");
  EXPECT_EQ(add(kAnn, {1, 6, 4, 2, 3}, "ef"), "");
  EXPECT_EQ(add(kAnn, {1, 6, 2, 1, 3}, "cd"), "CH:abcdef");
  EXPECT_EQ(add(kAnn, {2, 4, 2, 1, 2}, "cd"), "");
  EXPECT_EQ(add(kAnn, {2, 4, 0, 0, 2}, with_channel("ab")), "CH:abcd");
  EXPECT_EQ(store_.refused(), 0);
  EXPECT_EQ(store_.forgotten(), 0);
}

TEST_F(FragmentStoreTest, SendersNeverMix) {
  EXPECT_EQ(add(kAnn, {1, 4, 0, 0, 2}, with_channel("ab")), "");
  EXPECT_EQ(add(kBob, {1, 4, 2, 1, 2}, "yz"), "");
  EXPECT_EQ(add(kAnn, {1, 4, 2, 1, 2}, "cd"), "CH:abcd");
  EXPECT_EQ(add(kBob, {1, 4, 0, 0, 2}, with_channel("wx")), "CH:wxyz");
}

TEST_F(FragmentStoreTest, PieceThatComesTwiceOrDisagreesIsRefusedAndHarmsNothing) {
  EXPECT_EQ(add(kAnn, {1, 4, 0, 0, 2}, with_channel("ab")), "");
  EXPECT_EQ(add(kAnn, {1, 4, 0, 0, 2}, with_channel("XY")), "") << "twice";
  EXPECT_EQ(add(kAnn, {1, 5, 2, 1, 2}, "XYZ"), "") << "of another size";
  EXPECT_EQ(add(kAnn, {1, 4, 2, 1, 3}, "XY"), "") << "of another count";
  EXPECT_EQ(store_.refused(), 3);
  EXPECT_EQ(add(kAnn, {1, 4, 2, 1, 2}, "cd"), "CH:abcd");
}

TEST_F(FragmentStoreTest, PiecesThatLeaveAGapMakeNoMessage) {
  EXPECT_EQ(add(kAnn, {1, 6, 0, 0, 2}, with_channel("abc")), "");
  EXPECT_EQ(add(kAnn, {1, 6, 4, 1, 2}, "ef"), "");
  EXPECT_EQ(add(kAnn, {2, 6, 0, 0, 2}, with_channel("abcde")), "");
  EXPECT_EQ(add(kAnn, {2, 6, 3, 1, 2}, "def"), "") << "an overlap";
  EXPECT_EQ(store_.refused(), 2);
}

TEST_F(FragmentStoreTest, MessageThatIsNotFinishedIsForgotten) {
  add(kAnn, {1, 4, 0, 0, 2}, with_channel("ab"), 0);
  EXPECT_EQ(add(kAnn, {1, 4, 2, 1, 2}, "cd", FragmentStore::kPatience_us), "CH:abcd");
  add(kAnn, {2, 4, 0, 0, 2}, with_channel("ab"), 0);
  EXPECT_EQ(add(kAnn, {2, 4, 2, 1, 2}, "cd", FragmentStore::kPatience_us + 1), "");
  EXPECT_EQ(store_.forgotten(), 1);
}

TEST_F(FragmentStoreTest, HugeMessageIsRefusedBeforeItTakesMemory) {
  const auto huge = static_cast<std::uint32_t>(FragmentStore::kLargestMessage + 1);
  EXPECT_EQ(add(kAnn, {1, huge, 0, 0, 2}, with_channel("ab")), "");
  EXPECT_EQ(store_.refused(), 1);
}

TEST_F(FragmentStoreTest, ManyUnfinishedOnesTakeNoMoreThanTheirShareAndTheOldestGoes) {
  for (std::uint32_t seq = 0; seq < 200; ++seq) add(kAnn, {seq, 4, 0, 0, 2}, with_channel("ab"), seq);
  EXPECT_EQ(store_.forgotten(), 200 - static_cast<std::int64_t>(FragmentStore::kMostMessages));
  EXPECT_EQ(add(kAnn, {199, 4, 2, 1, 2}, "cd", 200), "CH:abcd") << "the newest is there";
  EXPECT_EQ(add(kAnn, {0, 4, 2, 1, 2}, "cd", 200), "") << "the oldest is not";
}

TEST_F(FragmentStoreTest, LargeUnfinishedOnesStayWithinTheLimitOfBytes) {
  const auto large = static_cast<std::uint32_t>(FragmentStore::kLargestMessage);
  for (std::uint32_t seq = 0; seq < 5; ++seq) add(kAnn, {seq, large, 0, 0, 300}, with_channel("ab"), seq);
  EXPECT_EQ(store_.forgotten(), 3) << "two of 16 MiB are 32";
}

}  // namespace
}  // namespace sprung
