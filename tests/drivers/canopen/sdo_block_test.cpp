#include "drivers/canopen/sdo_block.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprung::canopen {
namespace {

constexpr std::uint32_t kFromServer = 0x583;

SdoBlockFields acknowledged(int segments, int block_size = kMaxBlock) {
  SdoBlockFields fields;
  fields.acknowledged = segments;
  fields.size = block_size;
  return fields;
}

SdoBlockFields ended(int unused, std::uint16_t crc) {
  SdoBlockFields fields;
  fields.unused = unused;
  fields.crc = crc;
  return fields;
}

// The check value that catalogues of CRCs give for XMODEM, which this is.
TEST(BlockCrc, HasTheCheckValueOfItsPolynomial) {
  const char* digits = "123456789";
  EXPECT_EQ(block_crc(reinterpret_cast<const std::uint8_t*>(digits), 9), 0x31C3);
  EXPECT_EQ(block_crc(nullptr, 0), 0);
}

TEST(BlockSender, SendsWholeSegmentsAndWhatIsLeft) {
  const std::vector<std::uint8_t> value(17, 9);
  BlockSender sender;
  ASSERT_EQ(sender.begin(value.size(), 2), 0U);
  EXPECT_EQ(sender.unused(), 4);
  CanFrame frame;
  std::vector<int> commands;
  while (!sender.done()) {
    int sent = 0;
    for (; sender.next(kFromServer, value.data(), frame); ++sent) commands.push_back(frame.data[0]);
    ASSERT_EQ(sender.acknowledge(acknowledged(sent, 2)), 0U);
  }
  EXPECT_EQ(commands, (std::vector<int>{1, 2, 0x81}));
  EXPECT_FALSE(sender.next(kFromServer, value.data(), frame));
}

TEST(BlockSender, EmptyValueIsOneEmptySegment) {
  BlockSender sender;
  ASSERT_EQ(sender.begin(0, 127), 0U);
  EXPECT_EQ(sender.unused(), 7);
  CanFrame frame;
  const std::uint8_t nothing = 0;
  ASSERT_TRUE(sender.next(kFromServer, &nothing, frame));
  EXPECT_EQ(frame.data[0], 0x81);
  EXPECT_FALSE(sender.next(kFromServer, &nothing, frame));
}

TEST(BlockReceiver, PutsTogetherWhatComesInOrder) {
  const std::vector<std::uint8_t> value = {1, 2, 3, 4, 5, 6, 7, 8};
  SdoBuffer buffer;
  BlockReceiver receiver;
  bool due = false;
  ASSERT_EQ(buffer.expect(true, 8), 0U);
  receiver.begin();
  EXPECT_EQ(receiver.take(sdo_block_segment(kFromServer, 1, value.data(), 7, false), buffer, due), 0U);
  EXPECT_FALSE(due);
  EXPECT_EQ(receiver.take(sdo_block_segment(kFromServer, 2, &value[7], 1, true), buffer, due), 0U);
  EXPECT_TRUE(due);
  EXPECT_TRUE(receiver.complete());
  EXPECT_EQ(receiver.acknowledge(), 2);
  EXPECT_EQ(receiver.finish(ended(6, block_crc(value.data(), 8)), true, buffer), 0U);
  EXPECT_EQ(std::vector<std::uint8_t>(buffer.data(), buffer.data() + buffer.size()), value);
}

TEST(BlockReceiver, IgnoresWhatComesTwiceOrAfterALoss) {
  const std::vector<std::uint8_t> value(21, 5);
  SdoBuffer buffer;
  BlockReceiver receiver;
  bool due = false;
  ASSERT_EQ(buffer.expect(false, 0), 0U);
  receiver.begin();
  for (const int sequence : {1, 1, 3}) {
    const bool last = sequence == 3;
    receiver.take(sdo_block_segment(kFromServer, sequence, value.data(), 7, last), buffer, due);
  }
  EXPECT_TRUE(due);
  EXPECT_FALSE(receiver.complete());
  EXPECT_EQ(receiver.acknowledge(), 1);
  EXPECT_EQ(buffer.size(), 7U);
}

TEST(BlockReceiver, ABlockEndsWithSegment127) {
  const std::vector<std::uint8_t> value(7, 5);
  SdoBuffer buffer;
  BlockReceiver receiver;
  bool due = false;
  ASSERT_EQ(buffer.expect(false, 0), 0U);
  receiver.begin();
  for (int sequence = 1; sequence <= kMaxBlock; ++sequence) {
    EXPECT_FALSE(due);
    receiver.take(sdo_block_segment(kFromServer, sequence, value.data(), 7, false), buffer, due);
  }
  EXPECT_TRUE(due);
  EXPECT_EQ(receiver.acknowledge(), kMaxBlock);
}

TEST(BlockReceiver, MoreThanFitsIsRefused) {
  const std::vector<std::uint8_t> value(7, 5);
  SdoBuffer buffer;
  BlockReceiver receiver;
  bool due = false;
  ASSERT_EQ(buffer.expect(false, 0), 0U);
  receiver.begin();
  std::uint32_t error = 0;
  for (std::size_t sent = 0; error == 0 && sent < 2 * kMaxTransfer; sent += 7) {
    error = receiver.take(sdo_block_segment(kFromServer, receiver.in_order() + 1, value.data(), 7, false),
                          buffer, due);
    if (due) receiver.acknowledge();
  }
  EXPECT_EQ(error, kAbortMemory);
}

}  // namespace
}  // namespace sprung::canopen
