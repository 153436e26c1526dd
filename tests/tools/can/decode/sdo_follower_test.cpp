#include "tools/can/decode/sdo_follower.h"

#include <gtest/gtest.h>

#include "drivers/canopen/sdo_block.h"

namespace sprung::cantools {
namespace {

using canopen::ObjectId;
using canopen::SdoKind;
using Bytes = std::vector<std::uint8_t>;

constexpr int kNode = 1;
constexpr ObjectId kName{0x1008, 0}, kMode{0x6060, 0};
const Bytes kText = {'E', 'P', 'O', 'S', ' ', '2', '4', '/', '5'};

CanFrame read_segment(int from, int count, bool toggle, bool last) {
  return canopen::sdo_read_segment_reply(kNode, toggle, kText.data() + from, count, last);
}

CanFrame write_segment(int from, int count, bool toggle, bool last) {
  return canopen::sdo_write_segment(kNode, toggle, kText.data() + from, count, last);
}

TEST(SdoFollower, AnExpeditedReadIsCompleteWithItsReply) {
  SdoFollower follower;
  EXPECT_FALSE(follower.request(canopen::sdo_read_request(kNode, kMode)).complete);
  const SdoEvent event = follower.reply(canopen::sdo_read_reply(kNode, kMode, 10, 1));
  EXPECT_TRUE(event.complete);
  EXPECT_EQ(event.object, kMode);
  EXPECT_EQ(event.bytes, Bytes{10});
}

TEST(SdoFollower, AnExpeditedWriteIsCompleteWhenAcknowledged) {
  SdoFollower follower;
  const SdoEvent asked = follower.request(canopen::sdo_write_request(kNode, kMode, 8, 1));
  EXPECT_EQ(asked.bytes, Bytes{8});
  EXPECT_FALSE(asked.complete);
  const SdoEvent done = follower.reply(canopen::sdo_write_reply(kNode, kMode));
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.bytes, Bytes{8});
}

TEST(SdoFollower, AnAcknowledgementOfAnotherObjectCompletesNothing) {
  SdoFollower follower;
  follower.request(canopen::sdo_write_request(kNode, kMode, 8, 1));
  EXPECT_FALSE(follower.reply(canopen::sdo_write_reply(kNode, kName)).complete);
}

TEST(SdoFollower, SegmentsOfAReadAreToldWithTheirObjectAndPutTogether) {
  SdoFollower follower;
  follower.request(canopen::sdo_read_request(kNode, kName));
  EXPECT_EQ(follower.reply(canopen::sdo_read_begin_reply(kNode, kName, kText.size())).size, kText.size());
  const SdoEvent first = follower.reply(read_segment(0, 7, false, false));
  EXPECT_TRUE(first.known);
  EXPECT_EQ(first.object, kName);
  EXPECT_EQ(first.bytes, Bytes(kText.begin(), kText.begin() + 7));
  EXPECT_FALSE(first.complete);
  const SdoEvent last = follower.reply(read_segment(7, 2, true, true));
  EXPECT_TRUE(last.complete);
  EXPECT_EQ(last.bytes, kText);
}

TEST(SdoFollower, ASegmentedWriteIsCompleteWithTheLastAcknowledgement) {
  SdoFollower follower;
  EXPECT_EQ(follower.request(canopen::sdo_write_begin(kNode, kName, kText.size())).size, kText.size());
  EXPECT_FALSE(follower.reply(canopen::sdo_write_reply(kNode, kName)).complete) << "it has only begun";
  follower.request(write_segment(0, 7, false, false));
  EXPECT_FALSE(follower.reply(canopen::sdo_write_segment_reply(kNode, false)).complete);
  EXPECT_EQ(follower.request(write_segment(7, 2, true, true)).bytes, Bytes(kText.begin() + 7, kText.end()));
  const SdoEvent done = follower.reply(canopen::sdo_write_segment_reply(kNode, true));
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.bytes, kText);
}

TEST(SdoFollower, WhatBeganBeforeTheTraceHasNoObject) {
  SdoFollower follower;
  const SdoEvent event = follower.reply(read_segment(7, 2, true, true));
  EXPECT_FALSE(event.known);
  EXPECT_FALSE(event.complete);
}

TEST(SdoFollower, AnAbortEndsTheTransfer) {
  SdoFollower follower;
  follower.request(canopen::sdo_read_request(kNode, kName));
  const SdoEvent abort = follower.reply(canopen::sdo_server_abort(kNode, kName, canopen::kAbortDeviceState));
  EXPECT_EQ(abort.abort_code, canopen::kAbortDeviceState);
  EXPECT_FALSE(follower.reply(read_segment(0, 7, false, true)).known);
}

class SdoFollowerBlocks : public testing::Test {
 protected:
  CanFrame segment(std::uint32_t id, int sequence, int from, int count, bool last) const {
    return canopen::sdo_block_segment(id, sequence, kText.data() + from, count, last);
  }
  std::uint16_t crc_ = canopen::block_crc(kText.data(), kText.size());
  SdoFollower follower_;
};

TEST_F(SdoFollowerBlocks, ReadIsPutTogetherAndTaken) {
  const std::uint32_t id = canopen::sdo_server_id(kNode);
  follower_.request(canopen::sdo_block_read_request(kNode, kName, 0));
  EXPECT_EQ(follower_.reply(canopen::sdo_block_read_begin(kNode, kName, kText.size())).size, kText.size());
  follower_.request(canopen::sdo_block_read_start(kNode));
  const SdoEvent first = follower_.reply(segment(id, 1, 0, 7, false));
  EXPECT_EQ(first.segment, 1);
  EXPECT_EQ(first.object, kName);
  follower_.reply(segment(id, 2, 7, 2, true));
  const SdoEvent ack = follower_.request(canopen::sdo_block_read_ack(kNode, 2));
  EXPECT_FALSE(ack.repeats);
  EXPECT_FALSE(follower_.reply(canopen::sdo_block_read_end(kNode, 5, crc_)).wrong_crc);
  const SdoEvent done = follower_.request(canopen::sdo_block_read_taken(kNode));
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.bytes, kText);
}

TEST_F(SdoFollowerBlocks, WriteThatLostASegmentIsPutTogetherFromTheRepeat) {
  const std::uint32_t id = canopen::sdo_client_id(kNode);
  EXPECT_EQ(follower_.request(canopen::sdo_block_write_begin(kNode, kName, kText.size())).size, kText.size());
  follower_.reply(canopen::sdo_block_write_reply(kNode, kName));
  follower_.request(segment(id, 1, 0, 7, false));
  follower_.request(segment(id, 2, 7, 2, true));
  const SdoEvent ack = follower_.reply(canopen::sdo_block_write_ack(kNode, 1));
  EXPECT_TRUE(ack.repeats) << "the server missed what we saw";
  EXPECT_EQ(ack.segment, 1);
  follower_.request(segment(id, 1, 7, 2, true));
  follower_.reply(canopen::sdo_block_write_ack(kNode, 1));
  EXPECT_FALSE(follower_.request(canopen::sdo_block_write_end(kNode, 5, crc_)).wrong_crc);
  const SdoEvent done = follower_.reply(canopen::sdo_block_write_taken(kNode));
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.bytes, kText);
}

TEST_F(SdoFollowerBlocks, WrongChecksumIsSeen) {
  const std::uint32_t id = canopen::sdo_client_id(kNode);
  follower_.request(canopen::sdo_block_write_begin(kNode, kName, kText.size()));
  follower_.reply(canopen::sdo_block_write_reply(kNode, kName));
  follower_.request(segment(id, 1, 0, 7, false));
  follower_.request(segment(id, 2, 7, 2, true));
  follower_.reply(canopen::sdo_block_write_ack(kNode, 2));
  EXPECT_TRUE(follower_.request(canopen::sdo_block_write_end(kNode, 5, static_cast<std::uint16_t>(crc_ + 1)))
                  .wrong_crc);
}

TEST_F(SdoFollowerBlocks, AbortWithinABlockEndsIt) {
  follower_.request(canopen::sdo_block_write_begin(kNode, kName, kText.size()));
  follower_.reply(canopen::sdo_block_write_reply(kNode, kName));
  EXPECT_EQ(follower_.request(canopen::sdo_client_abort(kNode, kName, canopen::kAbortTimeout)).abort_code,
            canopen::kAbortTimeout);
  EXPECT_EQ(follower_.request(canopen::sdo_read_request(kNode, kMode)).kind, SdoKind::kUpload);
}

TEST_F(SdoFollowerBlocks, ServerThatAnswersPlainlyIsFollowedPlainly) {
  follower_.request(canopen::sdo_block_read_request(kNode, kMode, 28));
  const SdoEvent event = follower_.reply(canopen::sdo_read_reply(kNode, kMode, 10, 1));
  EXPECT_TRUE(event.complete);
  EXPECT_EQ(event.bytes, Bytes{10});
}

TEST(SdoText, BlocksAreTold) {
  SdoEvent event;
  event.kind = SdoKind::kBlockDownloadBegin;
  event.size = 300;
  EXPECT_EQ(sdo_text(event, false, "0x1020", ""), "write 0x1020, in blocks, 300 bytes");
  EXPECT_EQ(sdo_text(event, true, "0x1020", ""), "0x1020: first block");
  event.kind = SdoKind::kDownloadSegment;
  event.segment = 3;
  EXPECT_EQ(sdo_text(event, false, "0x1020", ""), "segment 3 of a block to 0x1020");
  event.kind = SdoKind::kBlockDownloadAck;
  event.repeats = true;
  EXPECT_EQ(sdo_text(event, true, "0x1020", ""), "0x1020: took 3 segments, the rest again");
  event.kind = SdoKind::kBlockDownloadEnd;
  event.wrong_crc = true;
  EXPECT_EQ(sdo_text(event, false, "0x1020", ""), "0x1020: end of blocks, WRONG CHECKSUM");
  event.complete = true;
  EXPECT_EQ(sdo_text(event, true, "0x1020", "\"x\""), "0x1020 written: \"x\"");
}

TEST(SdoText, ARequestAndItsReplyReadLikeALine) {
  SdoEvent event;
  event.kind = SdoKind::kDownload;
  EXPECT_EQ(sdo_text(event, false, "0x6060:00 mode", "8"), "write 0x6060:00 mode := 8");
  EXPECT_EQ(sdo_text(event, true, "0x6060:00 mode", ""), "0x6060:00 mode go on");
  event.complete = true;
  EXPECT_EQ(sdo_text(event, true, "0x6060:00 mode", "8"), "0x6060:00 mode written: 8");
  event.kind = SdoKind::kUpload;
  EXPECT_EQ(sdo_text(event, false, "", ""), "read an object asked for before the trace began");
}

}  // namespace
}  // namespace sprung::cantools
