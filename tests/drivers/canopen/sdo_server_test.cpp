#include "drivers/canopen/sdo_server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace sprung::canopen {
namespace {

constexpr std::int64_t kSdoServerTimeout_us = 5000;
constexpr ObjectId kSdoServerName{0x1008, 0};
constexpr ObjectId kNumber{0x1017, 0};

/// Objects as bytes; what is not there does not exist.
struct Store : SdoObjects {
  std::map<int, std::vector<std::uint8_t>> values;
  std::uint32_t refusal = 0;
  bool told = false;

  static int key(ObjectId object) { return object.index * 256 + object.sub; }
  std::uint32_t read(ObjectId object, std::uint8_t* bytes, std::size_t capacity,
                     std::size_t& size) noexcept override {
    const auto found = values.find(key(object));
    if (found == values.end()) return kAbortNoObject;
    size = found->second.size();
    std::copy_n(found->second.begin(), std::min(size, capacity), bytes);
    return 0;
  }
  std::uint32_t write(ObjectId object, const std::uint8_t* bytes, std::size_t size,
                      bool size_told) noexcept override {
    if (refusal != 0) return refusal;
    values[key(object)].assign(bytes, bytes + size);
    told = size_told;
    return 0;
  }
};

class SdoServerTest : public testing::Test {
 protected:
  CanFrame ask(const CanFrame& request, std::int64_t time_us = 0) {
    CanFrame reply;
    EXPECT_TRUE(server_.receive(request, time_us, reply));
    return reply;
  }
  static CanFrame with_command(CanFrame frame, int command) {
    frame.data[0] = static_cast<std::uint8_t>(command);
    return frame;
  }
  static CanFrame abort(ObjectId object, std::uint32_t code) { return sdo_server_abort(4, object, code); }
  std::vector<std::uint8_t>& value(ObjectId object) { return store_.values[Store::key(object)]; }

  Store store_;
  SdoServer server_{4, store_, kSdoServerTimeout_us};
};

const std::vector<std::uint8_t> kSdoServerText = {'E', 'P', 'O', 'S', '2', ' ', '5', '0', '/', '5'};

TEST_F(SdoServerTest, FewBytesAreReadExpedited) {
  for (const std::size_t size : {1U, 2U, 3U, 4U}) {
    value(kNumber).assign(kSdoServerText.begin(), kSdoServerText.begin() + static_cast<std::ptrdiff_t>(size));
    const int count = static_cast<int>(size);
    EXPECT_EQ(ask(sdo_read_request(4, kNumber)),
              sdo_read_reply(4, kNumber, get_le(kSdoServerText.data(), count), count));
    EXPECT_FALSE(server_.busy());
  }
}

TEST_F(SdoServerTest, ManyBytesAreReadInSegments) {
  value(kSdoServerName) = kSdoServerText;
  EXPECT_EQ(ask(sdo_read_request(4, kSdoServerName)), sdo_read_begin_reply(4, kSdoServerName, 10));
  EXPECT_TRUE(server_.busy());
  EXPECT_EQ(ask(sdo_read_segment_request(4, false)),
            sdo_read_segment_reply(4, false, kSdoServerText.data(), 7, false));
  EXPECT_EQ(ask(sdo_read_segment_request(4, true)),
            sdo_read_segment_reply(4, true, &kSdoServerText[7], 3, true));
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, SegmentsThatFitExactlyEndWithTheLastFullOne) {
  value(kSdoServerName).assign(14, 'x');
  ask(sdo_read_request(4, kSdoServerName));
  EXPECT_FALSE(decode_sdo_reply(ask(sdo_read_segment_request(4, false))).last);
  EXPECT_TRUE(decode_sdo_reply(ask(sdo_read_segment_request(4, true))).last);
}

TEST_F(SdoServerTest, EmptyValueIsOneEmptySegment) {
  value(kSdoServerName).clear();
  EXPECT_EQ(ask(sdo_read_request(4, kSdoServerName)), sdo_read_begin_reply(4, kSdoServerName, 0));
  EXPECT_EQ(ask(sdo_read_segment_request(4, false)),
            sdo_read_segment_reply(4, false, kSdoServerText.data(), 0, true));
}

TEST_F(SdoServerTest, ValueBeyondTheBufferIsRefused) {
  value(kSdoServerName).assign(kMaxTransfer + 1, 'x');
  EXPECT_EQ(ask(sdo_read_request(4, kSdoServerName)), abort(kSdoServerName, kAbortMemory));
  EXPECT_EQ(ask(sdo_write_begin(4, kSdoServerName, kMaxTransfer + 1)), abort(kSdoServerName, kAbortMemory));
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, ExpeditedWriteReachesTheObject) {
  EXPECT_EQ(ask(sdo_write_request(4, kNumber, 0x0105, 2)), sdo_write_reply(4, kNumber));
  EXPECT_EQ(value(kNumber), (std::vector<std::uint8_t>{5, 1}));
  EXPECT_TRUE(store_.told);
  ask(with_command(sdo_write_request(4, kNumber, 0x0105, 4), 0x22));
  EXPECT_EQ(value(kNumber), (std::vector<std::uint8_t>{5, 1, 0, 0}));
  EXPECT_FALSE(store_.told);
}

TEST_F(SdoServerTest, SegmentedWriteReachesTheObjectAtItsEnd) {
  for (const int command : {0x21, 0x20}) {
    value(kSdoServerName).clear();
    EXPECT_EQ(ask(with_command(sdo_write_begin(4, kSdoServerName, 10), command)),
              sdo_write_reply(4, kSdoServerName));
    EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false)),
              sdo_write_segment_reply(4, false));
    EXPECT_TRUE(value(kSdoServerName).empty());
    EXPECT_EQ(ask(sdo_write_segment(4, true, &kSdoServerText[7], 3, true)), sdo_write_segment_reply(4, true));
    EXPECT_EQ(value(kSdoServerName), kSdoServerText);
    EXPECT_TRUE(store_.told);
    EXPECT_FALSE(server_.busy());
  }
}

TEST_F(SdoServerTest, RefusalOfTheObjectIsTheAbortCode) {
  EXPECT_EQ(ask(sdo_read_request(4, {0x603F, 0})), abort({0x603F, 0}, kAbortNoObject));
  store_.refusal = kAbortReadOnly;
  EXPECT_EQ(ask(sdo_write_request(4, kNumber, 1, 2)), abort(kNumber, kAbortReadOnly));
  ask(sdo_write_begin(4, kSdoServerName, 3));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 3, true)),
            abort(kSdoServerName, kAbortReadOnly));
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, WrongToggleEndsTheTransfer) {
  value(kSdoServerName) = kSdoServerText;
  ask(sdo_read_request(4, kSdoServerName));
  EXPECT_EQ(ask(sdo_read_segment_request(4, true)), abort(kSdoServerName, kAbortToggle));
  EXPECT_FALSE(server_.busy());
  ask(sdo_write_begin(4, kSdoServerName, 10));
  ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false)),
            abort(kSdoServerName, kAbortToggle))
      << "the same segment twice";
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, MoreAndFewerBytesThanAnnouncedEndTheTransfer) {
  ask(sdo_write_begin(4, kSdoServerName, 6));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, true)),
            abort(kSdoServerName, kAbortTooLong));
  ask(sdo_write_begin(4, kSdoServerName, 8));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, true)),
            abort(kSdoServerName, kAbortTooShort));
  EXPECT_FALSE(server_.busy());
  EXPECT_EQ(store_.values.count(Store::key(kSdoServerName)), 0U) << "nothing was written";
}

TEST_F(SdoServerTest, WriteOfUntoldSizeBeyondTheBufferEnds) {
  ask(with_command(sdo_write_begin(4, kSdoServerName, 0), 0x20));
  bool toggle = false;
  for (std::size_t sent = 0; sent + 7 <= kMaxTransfer; sent += 7, toggle = !toggle) {
    ASSERT_EQ(ask(sdo_write_segment(4, toggle, kSdoServerText.data(), 7, false)),
              sdo_write_segment_reply(4, toggle));
  }
  EXPECT_EQ(ask(sdo_write_segment(4, toggle, kSdoServerText.data(), 7, false)),
            abort(kSdoServerName, kAbortMemory));
}

TEST_F(SdoServerTest, SegmentWithoutItsTransferIsABadCommand) {
  EXPECT_EQ(ask(sdo_read_segment_request(4, false)), abort({}, kAbortCommand));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, true)), abort({}, kAbortCommand));
  value(kSdoServerName) = kSdoServerText;
  ask(sdo_read_request(4, kSdoServerName));
  EXPECT_EQ(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, true)),
            abort(kSdoServerName, kAbortCommand))
      << "of the other direction";
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, UnknownCommandsAreRefused) {
  for (const int command : {0xE0, 0xA8, 0xC8, 0x41}) {
    EXPECT_EQ(ask(with_command(sdo_read_request(4, kSdoServerName), command)),
              abort(kSdoServerName, kAbortCommand))
        << std::hex << command;
  }
}

TEST_F(SdoServerTest, BlockIsReadSegmentBySegmentUnasked) {
  value(kSdoServerName) = kSdoServerText;
  EXPECT_EQ(ask(sdo_block_read_request(4, kSdoServerName, 0)), sdo_block_read_begin(4, kSdoServerName, 10));
  CanFrame out;
  EXPECT_FALSE(server_.step(1, out)) << "not before the client says so";
  EXPECT_FALSE(server_.receive(sdo_block_read_start(4), 1, out)) << "has no answer of its own";
  ASSERT_TRUE(server_.step(1, out));
  EXPECT_EQ(out, sdo_block_segment(sdo_server_id(4), 1, kSdoServerText.data(), 7, false));
  ASSERT_TRUE(server_.step(1, out));
  EXPECT_EQ(out, sdo_block_segment(sdo_server_id(4), 2, &kSdoServerText[7], 3, true));
  EXPECT_FALSE(server_.step(1, out));
  const std::uint16_t crc = block_crc(kSdoServerText.data(), kSdoServerText.size());
  EXPECT_EQ(ask(sdo_block_read_ack(4, 2)), sdo_block_read_end(4, 4, crc));
  EXPECT_TRUE(server_.busy());
  EXPECT_FALSE(server_.receive(sdo_block_read_taken(4), 1, out));
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, SegmentsThatWereLostAreSentAgain) {
  value(kSdoServerName) = kSdoServerText;
  ask(sdo_block_read_request(4, kSdoServerName, 0));
  CanFrame out;
  EXPECT_FALSE(server_.receive(sdo_block_read_start(4), 0, out));
  while (server_.step(0, out)) continue;
  EXPECT_FALSE(server_.receive(sdo_block_read_ack(4, 1), 0, out));
  ASSERT_TRUE(server_.step(0, out));
  EXPECT_EQ(out, sdo_block_segment(sdo_server_id(4), 1, &kSdoServerText[7], 3, true));
}

TEST_F(SdoServerTest, ValueUpToTheClientsThresholdIsReadPlainly) {
  value(kSdoServerName) = kSdoServerText;
  EXPECT_EQ(ask(sdo_block_read_request(4, kSdoServerName, 10)), sdo_read_begin_reply(4, kSdoServerName, 10));
  value(kNumber) = {5, 1};
  EXPECT_EQ(ask(sdo_block_read_request(4, kNumber, 10)), sdo_read_reply(4, kNumber, 0x0105, 2));
  EXPECT_EQ(ask(sdo_block_read_request(4, kSdoServerName, 9)), sdo_block_read_begin(4, kSdoServerName, 10));
}

TEST_F(SdoServerTest, ClientThatChecksNothingGetsNoChecksum) {
  value(kSdoServerName) = kSdoServerText;
  EXPECT_EQ(ask(with_command(sdo_block_read_request(4, kSdoServerName, 0), 0xA0)).data[0], 0xC2);
  CanFrame out;
  EXPECT_FALSE(server_.receive(sdo_block_read_start(4), 0, out));
  while (server_.step(0, out)) continue;
  EXPECT_EQ(ask(sdo_block_read_ack(4, 2)), sdo_block_read_end(4, 4, 0));
}

TEST_F(SdoServerTest, BlockSizesThatCannotBeEndTheTransfer) {
  value(kSdoServerName) = kSdoServerText;
  for (const int size : {0, 128, 255}) {
    CanFrame request = sdo_block_read_request(4, kSdoServerName, 0);
    request.data[4] = static_cast<std::uint8_t>(size);
    EXPECT_EQ(ask(request), abort(kSdoServerName, kAbortBlockSize)) << size;
  }
}

TEST_F(SdoServerTest, AcknowledgementOfWhatWasNeverSentEndsTheTransfer) {
  value(kSdoServerName) = kSdoServerText;
  ask(sdo_block_read_request(4, kSdoServerName, 0));
  CanFrame out;
  EXPECT_FALSE(server_.receive(sdo_block_read_start(4), 0, out));
  EXPECT_EQ(ask(sdo_block_read_ack(4, 1)), abort(kSdoServerName, kAbortBlockSequence));
}

class BlockWrite : public SdoServerTest {
 protected:
  void begin() {
    ASSERT_EQ(ask(sdo_block_write_begin(4, kSdoServerName, 10)), sdo_block_write_reply(4, kSdoServerName));
  }
  /// @return whether the server acknowledged: then `out_` is that.
  bool segment(int sequence, int from, int count, bool last, std::int64_t time_us = 0) {
    return server_.receive(sdo_block_segment(sdo_client_id(4), sequence,
                                             &kSdoServerText[static_cast<std::size_t>(from)], count, last),
                           time_us, out_);
  }
  std::uint16_t crc_ = block_crc(kSdoServerText.data(), kSdoServerText.size());
  CanFrame out_;
};

TEST_F(BlockWrite, ReachesTheObjectWithItsEnd) {
  begin();
  EXPECT_FALSE(segment(1, 0, 7, false));
  ASSERT_TRUE(segment(2, 7, 3, true));
  EXPECT_EQ(out_, sdo_block_write_ack(4, 2));
  EXPECT_TRUE(value(kSdoServerName).empty());
  EXPECT_EQ(ask(sdo_block_write_end(4, 4, crc_)), sdo_block_write_taken(4));
  EXPECT_EQ(value(kSdoServerName), kSdoServerText);
  EXPECT_FALSE(server_.busy());
}

TEST_F(BlockWrite, AcknowledgesWhatCameInOrderAndGoesOnBehindIt) {
  begin();
  EXPECT_FALSE(segment(1, 0, 7, false));
  ASSERT_TRUE(segment(3, 7, 3, true)) << "the second was lost";
  EXPECT_EQ(out_, sdo_block_write_ack(4, 1));
  ASSERT_TRUE(segment(1, 7, 3, true));
  EXPECT_EQ(out_, sdo_block_write_ack(4, 1));
  EXPECT_EQ(ask(sdo_block_write_end(4, 4, crc_)), sdo_block_write_taken(4));
  EXPECT_EQ(value(kSdoServerName), kSdoServerText);
}

TEST_F(BlockWrite, BlockWhoseLastSegmentWasLostIsAcknowledgedAfterAWhile) {
  begin();
  EXPECT_FALSE(segment(1, 0, 7, false, 100));
  EXPECT_FALSE(server_.step(100 + kSdoServerTimeout_us / 4 - 1, out_));
  ASSERT_TRUE(server_.step(100 + kSdoServerTimeout_us / 4, out_));
  EXPECT_EQ(out_, sdo_block_write_ack(4, 1));
  EXPECT_FALSE(server_.step(100 + kSdoServerTimeout_us / 2, out_)) << "once";
  ASSERT_TRUE(server_.step(100 + kSdoServerTimeout_us, out_));
  EXPECT_EQ(out_, abort(kSdoServerName, kAbortTimeout));
}

TEST_F(BlockWrite, WrongChecksumAndWrongLengthsAreRefused) {
  begin();
  segment(1, 0, 7, false);
  segment(2, 7, 3, true);
  EXPECT_EQ(ask(sdo_block_write_end(4, 4, static_cast<std::uint16_t>(crc_ + 1))),
            abort(kSdoServerName, kAbortBlockCrc));
  for (const int unused : {3, 5}) {
    begin();
    segment(1, 0, 7, false);
    segment(2, 7, 3, true);
    EXPECT_EQ(ask(sdo_block_write_end(4, unused, crc_)),
              abort(kSdoServerName, unused == 3 ? kAbortTooLong : kAbortTooShort));
  }
  EXPECT_TRUE(value(kSdoServerName).empty());
  EXPECT_EQ(ask(sdo_block_write_begin(4, kSdoServerName, kMaxTransfer + 1)),
            abort(kSdoServerName, kAbortMemory));
}

TEST_F(BlockWrite, RefusalOfTheObjectIsTheAbortCode) {
  store_.refusal = kAbortReadOnly;
  begin();
  segment(1, 0, 7, false);
  segment(2, 7, 3, true);
  EXPECT_EQ(ask(sdo_block_write_end(4, 4, crc_)), abort(kSdoServerName, kAbortReadOnly));
}

TEST_F(BlockWrite, AbortWithinABlockEndsIt) {
  begin();
  segment(1, 0, 7, false);
  EXPECT_FALSE(server_.receive(sdo_client_abort(4, kSdoServerName, kAbortGeneral), 0, out_));
  EXPECT_FALSE(server_.busy());
}

TEST_F(BlockWrite, FramesThatBringNothingOnDoNotHoldTheServer) {
  begin();
  CanFrame out;
  for (std::int64_t time_us = 0; time_us < kSdoServerTimeout_us; time_us += 500)
    server_.receive(sdo_read_request(4, kNumber), time_us, out);
  while (server_.step(kSdoServerTimeout_us, out)) continue;
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, BlockFramesOutOfTurnAreRefused) {
  for (const CanFrame& frame : {sdo_block_read_start(4), sdo_block_read_ack(4, 1), sdo_block_read_taken(4),
                                sdo_block_write_end(4, 0, 0)}) {
    EXPECT_EQ(decode_sdo_reply(ask(frame)).value, kAbortCommand);
  }
}

TEST_F(SdoServerTest, AbortOfTheClientEndsTheTransferWithoutAnswer) {
  ask(sdo_write_begin(4, kSdoServerName, 10));
  CanFrame reply;
  EXPECT_FALSE(server_.receive(sdo_client_abort(4, kSdoServerName, kAbortTimeout), 0, reply));
  EXPECT_FALSE(server_.busy());
}

TEST_F(SdoServerTest, NewTransferReplacesAnUnfinishedOne) {
  value(kSdoServerName) = kSdoServerText;
  ask(sdo_write_begin(4, kSdoServerName, 10));
  ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false));
  EXPECT_EQ(ask(sdo_read_request(4, kSdoServerName)), sdo_read_begin_reply(4, kSdoServerName, 10));
  EXPECT_EQ(ask(sdo_read_segment_request(4, false)),
            sdo_read_segment_reply(4, false, kSdoServerText.data(), 7, false));
}

TEST_F(SdoServerTest, SilenceOfTheClientEndsTheTransferOnce) {
  CanFrame out;
  EXPECT_FALSE(server_.step(1'000'000, out)) << "nothing under way";
  ask(sdo_write_begin(4, kSdoServerName, 10), 100);
  ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false), 2000);
  EXPECT_FALSE(server_.step(2000 + kSdoServerTimeout_us - 1, out));
  ASSERT_TRUE(server_.step(2000 + kSdoServerTimeout_us, out));
  EXPECT_EQ(out, abort(kSdoServerName, kAbortTimeout));
  EXPECT_FALSE(server_.busy());
  EXPECT_FALSE(server_.step(10 * kSdoServerTimeout_us, out));
}

TEST_F(SdoServerTest, ResetForgetsTheTransfer) {
  ask(sdo_write_begin(4, kSdoServerName, 10));
  server_.reset();
  EXPECT_FALSE(server_.busy());
  EXPECT_EQ(decode_sdo_reply(ask(sdo_write_segment(4, false, kSdoServerText.data(), 7, false))).value,
            kAbortCommand);
}

TEST_F(SdoServerTest, FramesThatAreNoRequestHaveNoAnswer) {
  CanFrame reply;
  EXPECT_FALSE(server_.receive(sdo_read_request(5, kSdoServerName), 0, reply)) << "of another node";
  CanFrame brief = sdo_read_request(4, kSdoServerName);
  brief.length = 7;
  EXPECT_FALSE(server_.receive(brief, 0, reply));
  CanFrame remote = sdo_read_request(4, kSdoServerName);
  remote.remote = true;
  EXPECT_FALSE(server_.receive(remote, 0, reply));
}

}  // namespace
}  // namespace sprung::canopen
