#include "tools/can/decode/sdo_follower.h"

#include <gtest/gtest.h>

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
