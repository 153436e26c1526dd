#include "drivers/canopen/sdo_client.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprung::canopen {
namespace {

constexpr std::int64_t kTimeout_us = 1000;
constexpr ObjectId kName{0x1008, 0};
constexpr std::uint8_t kText[] = "EPOS2 50/5 of the left knee";

class SdoClientTest : public testing::Test {
 protected:
  bool step(std::int64_t time_us) { return client_.step(time_us, request_); }

  /// Up to the first request for a segment.
  void begin_read(std::size_t size) {
    client_.read(kName);
    ASSERT_TRUE(step(0));
    client_.receive(sdo_read_begin_reply(3, kName, size));
    ASSERT_TRUE(step(0));
  }
  /// The abort just sent by the client.
  void expect_own_abort(std::uint32_t code) {
    EXPECT_EQ(request_, sdo_client_abort(3, kName, code));
    EXPECT_EQ(client_.status(), SdoStatus::kAborted);
    EXPECT_EQ(client_.abort_code(), code);
    EXPECT_FALSE(step(10 * kTimeout_us));
  }
  std::vector<int> bytes() const { return {client_.data(), client_.data() + client_.size()}; }

  SdoClient client_{3, kTimeout_us};
  CanFrame request_;
};

TEST_F(SdoClientTest, ReadSendsOnceAndHoldsTheAnswer) {
  client_.read({0x6079, 0});
  EXPECT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_read_request(3, {0x6079, 0}));
  EXPECT_FALSE(step(10));
  client_.receive(sdo_read_reply(3, {0x6079, 0}, 48000, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.value(), 48000U);
  client_.finish();
  EXPECT_TRUE(client_.idle());
}

TEST_F(SdoClientTest, WriteIsDoneWhenAcknowledged) {
  client_.write({0x1017, 0}, 5, 2);
  EXPECT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_write_request(3, {0x1017, 0}, 5, 2));
  client_.receive(sdo_write_reply(3, {0x1017, 0}));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, SilenceIsRetriedOnceThenGivenUp) {
  client_.read({0x1000, 0});
  EXPECT_TRUE(step(0));
  EXPECT_FALSE(step(kTimeout_us - 1));
  EXPECT_TRUE(step(kTimeout_us));
  EXPECT_FALSE(step(2 * kTimeout_us - 1));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
  EXPECT_FALSE(step(2 * kTimeout_us));
  EXPECT_EQ(client_.status(), SdoStatus::kTimeout);
}

TEST_F(SdoClientTest, AnswerToTheRetryCounts) {
  client_.read({0x1000, 0});
  step(0);
  step(kTimeout_us);
  client_.receive(sdo_read_reply(3, {0x1000, 0}, 7, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, AbortKeepsItsCode) {
  client_.write({0x6072, 0}, 1, 2);
  step(0);
  client_.receive(sdo_server_abort(3, {0x6072, 0}, kAbortTooHigh));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), kAbortTooHigh);
}

TEST_F(SdoClientTest, AnswersToOtherQuestionsAreIgnored) {
  client_.receive(sdo_read_reply(3, {0x1000, 0}, 7, 4));
  EXPECT_TRUE(client_.idle());
  client_.read({0x6072, 0});
  client_.receive(sdo_read_reply(3, {0x6072, 0}, 7, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy) << "answered before it was asked";
  step(0);
  client_.receive(sdo_read_reply(3, {0x6072, 1}, 7, 4));
  client_.receive(sdo_write_reply(3, {0x6072, 0}));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
}

TEST_F(SdoClientTest, AnswersOfOtherNodesAreIgnored) {
  client_.read({0x1000, 0});
  step(0);
  client_.receive(sdo_read_reply(4, {0x1000, 0}, 7, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
}

TEST_F(SdoClientTest, ExpeditedValueIsThereAsBytesToo) {
  client_.read({0x6041, 0});
  step(0);
  client_.receive(sdo_read_reply(3, {0x6041, 0}, 0x0137, 2));
  EXPECT_EQ(bytes(), (std::vector<int>{0x37, 0x01}));
}

TEST_F(SdoClientTest, ExpeditedValueOfUntoldSizeIsFourBytes) {
  client_.read({0x6041, 0});
  step(0);
  CanFrame reply = sdo_read_reply(3, {0x6041, 0}, 0x0137, 4);
  reply.data[0] = 0x42;
  client_.receive(reply);
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(bytes(), (std::vector<int>{0x37, 0x01, 0, 0}));
  EXPECT_EQ(client_.value(), 0x0137U);
}

TEST_F(SdoClientTest, ReadInSegmentsGoesOnUntilTheLast) {
  begin_read(9);
  EXPECT_EQ(request_, sdo_read_segment_request(3, false));
  client_.receive(sdo_read_segment_reply(3, false, kText, 7, false));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_read_segment_request(3, true));
  client_.receive(sdo_read_segment_reply(3, true, kText + 7, 2, true));
  EXPECT_FALSE(step(0));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(bytes(), std::vector<int>(kText, kText + 9));
  EXPECT_EQ(client_.value(), get_le(kText, 4));
}

TEST_F(SdoClientTest, ReadInSegmentsOfUntoldSizeEndsWhereTheServerSays) {
  client_.read(kName);
  step(0);
  CanFrame first = sdo_read_begin_reply(3, kName, 77);
  first.data[0] = 0x40;
  client_.receive(first);
  step(0);
  client_.receive(sdo_read_segment_reply(3, false, kText, 3, true));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(bytes(), std::vector<int>(kText, kText + 3));
}

TEST_F(SdoClientTest, NumberInSegmentsIsANumber) {
  begin_read(2);
  client_.receive(sdo_read_segment_reply(3, false, kText, 2, true));
  EXPECT_EQ(client_.value(), get_le(kText, 2));
}

TEST_F(SdoClientTest, WriteOfManyBytesGoesInSegments) {
  client_.write(kName, kText, 16);
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_write_begin(3, kName, 16));
  client_.receive(sdo_write_reply(3, kName));
  for (int segment = 0; segment < 3; ++segment) {
    const bool toggle = segment == 1, last = segment == 2;
    ASSERT_TRUE(step(0));
    EXPECT_EQ(request_, sdo_write_segment(3, toggle, kText + 7 * segment, last ? 2 : 7, last));
    EXPECT_EQ(client_.status(), SdoStatus::kBusy);
    client_.receive(sdo_write_segment_reply(3, toggle));
  }
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, WriteOfFewBytesIsExpedited) {
  for (const std::size_t count : {1U, 2U, 3U, 4U}) {
    client_.write({0x1017, 0}, kText, count);
    ASSERT_TRUE(step(0));
    const int size = static_cast<int>(count);
    EXPECT_EQ(request_, sdo_write_request(3, {0x1017, 0}, get_le(kText, size), size));
  }
}

TEST_F(SdoClientTest, WriteOfNothingIsOneEmptySegment) {
  client_.write(kName, kText, 0);
  step(0);
  EXPECT_EQ(request_, sdo_write_begin(3, kName, 0));
  client_.receive(sdo_write_reply(3, kName));
  step(0);
  EXPECT_EQ(request_, sdo_write_segment(3, false, kText, 0, true));
}

TEST_F(SdoClientTest, WriteBeyondTheBufferIsRefusedBeforeAnythingIsSent) {
  const std::vector<std::uint8_t> long_bytes(kMaxTransfer + 1);
  client_.write(kName, long_bytes.data(), long_bytes.size());
  EXPECT_FALSE(step(0));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), kAbortMemory);
}

TEST_F(SdoClientTest, LongestWriteThatFitsIsSent) {
  const std::vector<std::uint8_t> bytes(kMaxTransfer);
  client_.write(kName, bytes.data(), bytes.size());
  EXPECT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_write_begin(3, kName, kMaxTransfer));
}

TEST_F(SdoClientTest, ReadBeyondTheBufferIsAborted) {
  begin_read(kMaxTransfer + 1);
  expect_own_abort(kAbortMemory);
}

TEST_F(SdoClientTest, ReadOfUntoldSizeBeyondTheBufferIsAborted) {
  client_.read(kName);
  step(0);
  CanFrame first = sdo_read_begin_reply(3, kName, 0);
  first.data[0] = 0x40;
  client_.receive(first);
  bool toggle = false;
  for (std::size_t sent = 0; sent + 7 <= kMaxTransfer; sent += 7, toggle = !toggle) {
    ASSERT_TRUE(step(0));
    ASSERT_EQ(request_, sdo_read_segment_request(3, toggle));
    client_.receive(sdo_read_segment_reply(3, toggle, kText, 7, false));
  }
  ASSERT_TRUE(step(0));
  client_.receive(sdo_read_segment_reply(3, toggle, kText, 7, false));
  step(0);
  expect_own_abort(kAbortMemory);
}

TEST_F(SdoClientTest, WrongToggleOfAReadIsAborted) {
  begin_read(9);
  client_.receive(sdo_read_segment_reply(3, true, kText, 7, false));
  step(0);
  expect_own_abort(kAbortToggle);
}

TEST_F(SdoClientTest, WrongToggleOfAWriteIsAborted) {
  client_.write(kName, kText, 16);
  step(0);
  client_.receive(sdo_write_reply(3, kName));
  step(0);
  client_.receive(sdo_write_segment_reply(3, true));
  step(0);
  expect_own_abort(kAbortToggle);
}

TEST_F(SdoClientTest, MoreAndFewerBytesThanAnnouncedAreAborted) {
  begin_read(9);
  client_.receive(sdo_read_segment_reply(3, false, kText, 7, true));
  step(0);
  expect_own_abort(kAbortTooShort);
  begin_read(6);
  client_.receive(sdo_read_segment_reply(3, false, kText, 7, true));
  step(0);
  expect_own_abort(kAbortTooLong);
}

TEST_F(SdoClientTest, AbortOfTheServerEndsASegmentedTransfer) {
  begin_read(9);
  client_.receive(sdo_server_abort(3, {0x2000, 0}, kAbortGeneral));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy) << "of another object";
  client_.receive(sdo_server_abort(3, kName, kAbortGeneral));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), kAbortGeneral);
  EXPECT_FALSE(step(0)) << "nothing to say to a server that gave up";
}

TEST_F(SdoClientTest, SilenceWithinSegmentsTellsTheServerAndBeginsAgain) {
  begin_read(9);
  EXPECT_FALSE(step(kTimeout_us - 1));
  ASSERT_TRUE(step(kTimeout_us));
  EXPECT_EQ(request_, sdo_client_abort(3, kName, kAbortTimeout));
  ASSERT_TRUE(step(kTimeout_us));
  EXPECT_EQ(request_, sdo_read_request(3, kName));
  client_.receive(sdo_read_begin_reply(3, kName, 3));
  step(kTimeout_us);
  client_.receive(sdo_read_segment_reply(3, false, kText, 3, true));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(bytes(), std::vector<int>(kText, kText + 3)) << "nothing left of the first attempt";
}

TEST_F(SdoClientTest, SecondSilenceWithinSegmentsEndsIt) {
  client_.write(kName, kText, 16);
  for (const std::int64_t begin_us : {std::int64_t{0}, kTimeout_us}) {
    ASSERT_TRUE(step(begin_us));
    EXPECT_EQ(request_, sdo_write_begin(3, kName, 16));
    client_.receive(sdo_write_reply(3, kName));
    ASSERT_TRUE(step(begin_us));
    EXPECT_EQ(request_, sdo_write_segment(3, false, kText, 7, false)) << "from the beginning";
    ASSERT_TRUE(step(begin_us + kTimeout_us));
    EXPECT_EQ(request_, sdo_client_abort(3, kName, kAbortTimeout));
  }
  EXPECT_EQ(client_.status(), SdoStatus::kTimeout);
  EXPECT_FALSE(step(2 * kTimeout_us));
}

TEST_F(SdoClientTest, EverySegmentHasItsOwnTimeout) {
  begin_read(9);
  client_.receive(sdo_read_segment_reply(3, false, kText, 7, false));
  ASSERT_TRUE(step(kTimeout_us - 1));
  EXPECT_FALSE(step(2 * kTimeout_us - 2));
  EXPECT_TRUE(step(2 * kTimeout_us - 1));
}

/// A value that is worth a block: 31 bytes, five segments.
class SdoClientBlockTest : public SdoClientTest {
 protected:
  static constexpr std::size_t kLong = 31;
  SdoClientBlockTest() {
    for (std::size_t i = 0; i < kLong; ++i) long_.push_back(static_cast<std::uint8_t>(i * 7));
    crc_ = block_crc(long_.data(), kLong);
  }
  CanFrame segment(int sequence, int from, bool last) const {
    const int count = last ? 3 : 7;
    return sdo_block_segment(sdo_server_id(3), sequence, &long_[static_cast<std::size_t>(from) * 7], count,
                             last);
  }
  /// Up to the start of the first block.
  void begin_block_read() {
    client_.read(kName, SdoService::kBlock);
    ASSERT_TRUE(step(0));
    ASSERT_EQ(request_, sdo_block_read_request(3, kName, kBlockWorthwhile));
    client_.receive(sdo_block_read_begin(3, kName, kLong));
    ASSERT_TRUE(step(0));
    ASSERT_EQ(request_, sdo_block_read_start(3));
    ASSERT_FALSE(step(0));
  }
  void begin_block_write(int block_size) {
    client_.write(kName, long_.data(), kLong, SdoService::kBlock);
    ASSERT_TRUE(step(0));
    ASSERT_EQ(request_, sdo_block_write_begin(3, kName, kLong));
    CanFrame reply = sdo_block_write_reply(3, kName);
    reply.data[4] = static_cast<std::uint8_t>(block_size);
    client_.receive(reply);
  }
  CanFrame ack(int acknowledged, int block_size) const {
    CanFrame frame = sdo_block_write_ack(3, acknowledged);
    frame.data[2] = static_cast<std::uint8_t>(block_size);
    return frame;
  }
  std::vector<std::uint8_t> long_;
  std::uint16_t crc_ = 0;
};

TEST_F(SdoClientBlockTest, ReadsABlockAndSaysThatItWasTaken) {
  begin_block_read();
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(step(0));
    client_.receive(segment(i + 1, i, i == 4));
  }
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_read_ack(3, 5));
  client_.receive(sdo_block_read_end(3, 4, crc_));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_read_taken(3));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(bytes(), std::vector<int>(long_.begin(), long_.end()));
}

TEST_F(SdoClientBlockTest, SegmentThatWasLostIsAskedForAgain) {
  begin_block_read();
  client_.receive(segment(1, 0, false));
  client_.receive(segment(3, 2, false));
  client_.receive(segment(5, 4, true));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_read_ack(3, 1));
  for (int i = 1; i < 5; ++i) client_.receive(segment(i, i, i == 4));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_read_ack(3, 4));
  client_.receive(sdo_block_read_end(3, 4, crc_));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(bytes(), std::vector<int>(long_.begin(), long_.end()));
}

TEST_F(SdoClientBlockTest, BlockThatBreaksOffIsAcknowledgedAsFarAsItCame) {
  begin_block_read();
  client_.receive(segment(1, 0, false));
  EXPECT_FALSE(step(5)) << "it was heard now";
  EXPECT_FALSE(step(kTimeout_us + 4));
  ASSERT_TRUE(step(kTimeout_us + 5));
  EXPECT_EQ(request_, sdo_block_read_ack(3, 1));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
}

TEST_F(SdoClientBlockTest, WrongChecksumIsTold) {
  begin_block_read();
  for (int i = 0; i < 5; ++i) client_.receive(segment(i + 1, i, i == 4));
  ASSERT_TRUE(step(0));
  client_.receive(sdo_block_read_end(3, 4, static_cast<std::uint16_t>(crc_ ^ 1)));
  step(0);
  expect_own_abort(kAbortBlockCrc);
}

TEST_F(SdoClientBlockTest, ServerThatAnswersPlainlyIsReadPlainly) {
  client_.read(kName, SdoService::kBlock);
  step(0);
  client_.receive(sdo_read_begin_reply(3, kName, 9));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_read_segment_request(3, false));
  client_.read({0x6041, 0}, SdoService::kBlock);
  step(0);
  client_.receive(sdo_read_reply(3, {0x6041, 0}, 0x0137, 2));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.value(), 0x0137U);
}

TEST_F(SdoClientBlockTest, ServerWithoutBlocksIsAskedPlainlyAtOnce) {
  client_.read(kName, SdoService::kBlock);
  step(0);
  client_.receive(sdo_server_abort(3, {0, 0}, kAbortCommand));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_read_request(3, kName));
  client_.write(kName, long_.data(), kLong, SdoService::kBlock);
  step(0);
  client_.receive(sdo_server_abort(3, kName, kAbortCommand));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_write_begin(3, kName, kLong));
}

TEST_F(SdoClientBlockTest, ServerThatIsSilentAboutBlocksIsAskedPlainly) {
  client_.read(kName, SdoService::kBlock);
  step(0);
  ASSERT_TRUE(step(kTimeout_us));
  EXPECT_EQ(request_, sdo_read_request(3, kName));
  client_.receive(sdo_block_read_begin(3, kName, kLong));
  EXPECT_FALSE(step(kTimeout_us)) << "too late";
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
}

TEST_F(SdoClientBlockTest, OtherRefusalsAreTheAnswer) {
  client_.read(kName, SdoService::kBlock);
  step(0);
  client_.receive(sdo_server_abort(3, kName, kAbortNoObject));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), kAbortNoObject);
}

TEST_F(SdoClientBlockTest, WritesBlocksOfTheServersSize) {
  begin_block_write(2);
  const auto expect = [&](int sequence, int at) {
    const bool last = at == 4;
    ASSERT_TRUE(step(0));
    EXPECT_EQ(request_, sdo_block_segment(sdo_client_id(3), sequence,
                                          &long_[static_cast<std::size_t>(at) * 7], last ? 3 : 7, last));
  };
  expect(1, 0);
  expect(2, 1);
  EXPECT_FALSE(step(0)) << "waits for the acknowledgement";
  client_.receive(ack(1, 3));  // the second was lost; the next block may have three
  expect(1, 1);
  expect(2, 2);
  expect(3, 3);
  EXPECT_FALSE(step(0));
  client_.receive(ack(3, 3));
  expect(1, 4);
  EXPECT_FALSE(step(0));
  client_.receive(ack(1, 3));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_write_end(3, 4, crc_));
  client_.receive(sdo_block_write_taken(3));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientBlockTest, ServerWithoutChecksumGetsNone) {
  client_.write(kName, long_.data(), kLong, SdoService::kBlock);
  step(0);
  CanFrame reply = sdo_block_write_reply(3, kName);
  reply.data[0] = 0xA0;
  client_.receive(reply);
  while (step(0)) continue;
  client_.receive(ack(5, 127));
  ASSERT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_block_write_end(3, 4, 0));
}

TEST_F(SdoClientBlockTest, BlockSizesAndSegmentsThatCannotBeAreAborted) {
  begin_block_write(0);
  step(0);
  expect_own_abort(kAbortBlockSize);
  begin_block_write(2);
  while (step(0)) continue;
  client_.receive(ack(3, 2));
  step(0);
  expect_own_abort(kAbortBlockSequence);
}

TEST_F(SdoClientBlockTest, BlockOfWhichNothingEverArrivesIsGivenUp) {
  begin_block_write(2);
  int blocks = 0;
  while (client_.status() == SdoStatus::kBusy && blocks < 100) {
    while (step(0)) continue;
    client_.receive(ack(0, 2));
    ++blocks;
  }
  EXPECT_LT(blocks, 20);
  EXPECT_EQ(client_.abort_code(), kAbortBlockSequence);
}

TEST_F(SdoClientBlockTest, FewBytesAreNotWorthABlock) {
  client_.write(kName, long_.data(), kBlockWorthwhile, SdoService::kBlock);
  step(0);
  EXPECT_EQ(request_, sdo_write_begin(3, kName, kBlockWorthwhile));
}

TEST_F(SdoClientBlockTest, SilenceWithinABlockIsToldAndTriedInSegments) {
  begin_block_write(2);
  while (step(0)) continue;
  ASSERT_TRUE(step(kTimeout_us));
  EXPECT_EQ(request_, sdo_client_abort(3, kName, kAbortTimeout));
  ASSERT_TRUE(step(kTimeout_us));
  EXPECT_EQ(request_, sdo_write_begin(3, kName, kLong));
}

}  // namespace
}  // namespace sprung::canopen
