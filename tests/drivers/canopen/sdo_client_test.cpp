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

}  // namespace
}  // namespace sprung::canopen
