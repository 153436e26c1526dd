#include "drivers/canopen/sdo_frames.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/canopen/pdo_words.h"

namespace sprung::canopen {
namespace {

using Bytes = std::vector<int>;

Bytes bytes(const CanFrame& frame) { return {frame.data.begin(), frame.data.begin() + frame.length}; }

CanFrame with_command(CanFrame frame, int command) {
  frame.data[0] = static_cast<std::uint8_t>(command);
  return frame;
}

// Facts canopen 1.5: what python-canopen sent to node 1 to remap TPDO1, in this order.
TEST(SdoFrames, RemapHasTheBytesOfAnIndependentMaster) {
  const struct {
    CanFrame request;
    Bytes expected;
  } rows[] = {
      {sdo_write_request(1, {0x1800, 1}, kPdoInvalid | kPdoNoRtr | tpdo_id(0, 1), 4),
       {0x23, 0x00, 0x18, 0x01, 0x81, 0x01, 0x00, 0xC0}},
      {sdo_write_request(1, {0x1800, 2}, kTypeEverySync, 1), {0x2F, 0x00, 0x18, 0x02, 0x01, 0, 0, 0}},
      {sdo_write_request(1, {0x1800, 3}, 10, 2), {0x2B, 0x00, 0x18, 0x03, 0x0A, 0, 0, 0}},
      {sdo_write_request(1, {0x1A00, 0}, 0, 1), {0x2F, 0x00, 0x1A, 0x00, 0x00, 0, 0, 0}},
      {sdo_write_request(1, {0x1A00, 1}, encode_map_entry({{0x6064, 0}, 32}), 4),
       {0x23, 0x00, 0x1A, 0x01, 0x20, 0x00, 0x64, 0x60}},
      {sdo_write_request(1, {0x1A00, 2}, encode_map_entry({{0x6078, 0}, 16}), 4),
       {0x23, 0x00, 0x1A, 0x02, 0x10, 0x00, 0x78, 0x60}},
      {sdo_write_request(1, {0x1A00, 3}, encode_map_entry({{0x6041, 0}, 16}), 4),
       {0x23, 0x00, 0x1A, 0x03, 0x10, 0x00, 0x41, 0x60}},
      {sdo_write_request(1, {0x1A00, 0}, 3, 1), {0x2F, 0x00, 0x1A, 0x00, 0x03, 0, 0, 0}},
      {sdo_write_request(1, {0x1800, 1}, kPdoNoRtr | tpdo_id(0, 1), 4),
       {0x23, 0x00, 0x18, 0x01, 0x81, 0x01, 0x00, 0x40}},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(row.request.id, 0x601U);
    EXPECT_EQ(bytes(row.request), row.expected);
  }
}

// Facts canopen 1.4, one row a service; node 5.
TEST(SdoFrames, EveryServiceHasItsBytes) {
  const std::uint8_t text[] = {'a', 'b', 'c', 'd', 'e', 'f', 'g'};
  const struct {
    CanFrame frame;
    std::uint32_t id;
    Bytes expected;
  } rows[] = {
      {sdo_read_request(5, {0x1008, 0}), 0x605, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0}},
      {sdo_read_segment_request(5, false), 0x605, {0x60, 0, 0, 0, 0, 0, 0, 0}},
      {sdo_read_segment_request(5, true), 0x605, {0x70, 0, 0, 0, 0, 0, 0, 0}},
      {sdo_write_request(5, {0x2001, 0}, 0xA1B2C3, 3), 0x605, {0x27, 0x01, 0x20, 0, 0xC3, 0xB2, 0xA1, 0}},
      {sdo_write_begin(5, {0x1F50, 1}, 300), 0x605, {0x21, 0x50, 0x1F, 1, 0x2C, 0x01, 0, 0}},
      {sdo_write_segment(5, false, text, 7, false), 0x605, {0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}},
      {sdo_write_segment(5, true, text, 3, true), 0x605, {0x19, 'a', 'b', 'c', 0, 0, 0, 0}},
      {sdo_write_segment(5, true, text, 0, true), 0x605, {0x1F, 0, 0, 0, 0, 0, 0, 0}},
      {sdo_client_abort(5, {0x1008, 0}, kAbortTimeout), 0x605, {0x80, 0x08, 0x10, 0, 0, 0, 0x04, 0x05}},
      {sdo_read_reply(5, {0x6061, 0}, 0xFD, 1), 0x585, {0x4F, 0x61, 0x60, 0, 0xFD, 0, 0, 0}},
      {sdo_read_reply(5, {0x6041, 0}, 0x0137, 2), 0x585, {0x4B, 0x41, 0x60, 0, 0x37, 0x01, 0, 0}},
      {sdo_read_reply(5, {0x1000, 0}, 0x00020192, 4), 0x585, {0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0}},
      {sdo_read_begin_reply(5, {0x1008, 0}, 12), 0x585, {0x41, 0x08, 0x10, 0, 12, 0, 0, 0}},
      {sdo_read_segment_reply(5, false, text, 7, false), 0x585, {0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}},
      {sdo_read_segment_reply(5, true, text, 5, true), 0x585, {0x15, 'a', 'b', 'c', 'd', 'e', 0, 0}},
      {sdo_write_reply(5, {0x1017, 0}), 0x585, {0x60, 0x17, 0x10, 0, 0, 0, 0, 0}},
      {sdo_write_segment_reply(5, false), 0x585, {0x20, 0, 0, 0, 0, 0, 0, 0}},
      {sdo_write_segment_reply(5, true), 0x585, {0x30, 0, 0, 0, 0, 0, 0, 0}},
      {sdo_server_abort(5, {0x603F, 0}, kAbortNoObject), 0x585, {0x80, 0x3F, 0x60, 0, 0, 0, 0x02, 0x06}},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(row.frame.id, row.id) << row.expected[0];
    EXPECT_EQ(bytes(row.frame), row.expected);
  }
}

TEST(SdoFrames, ValueBeyondItsSizeDoesNotReachTheWire) {
  EXPECT_EQ(bytes(sdo_write_request(1, {0x6060, 0}, 0xFFFFFFFD, 1)),
            (Bytes{0x2F, 0x60, 0x60, 0, 0xFD, 0, 0, 0}));
}

TEST(SdoServerSide, UnderstandsEveryExpeditedRequestOfTheClient) {
  for (const int size : {1, 2, 3, 4}) {
    const std::uint32_t value = 0xA1B2C3D4U >> (8 * (4 - size));
    const SdoMessage write = decode_sdo_request(sdo_write_request(5, {0x6072, 7}, value, size));
    EXPECT_EQ(write.kind, SdoKind::kDownload);
    EXPECT_EQ(write.object, (ObjectId{0x6072, 7}));
    EXPECT_EQ(write.value, value);
    EXPECT_EQ(write.size, size);
  }
  const SdoMessage read = decode_sdo_request(sdo_read_request(5, {0x1018, 2}));
  EXPECT_EQ(read.kind, SdoKind::kUpload);
  EXPECT_EQ(read.object, (ObjectId{0x1018, 2}));
  const SdoMessage abort = decode_sdo_request(sdo_client_abort(5, {0x1018, 2}, kAbortTimeout));
  EXPECT_EQ(abort.kind, SdoKind::kAbort);
  EXPECT_EQ(abort.value, kAbortTimeout);
}

TEST(SdoClientSide, UnderstandsEveryExpeditedReplyOfTheServer) {
  for (const int size : {1, 2, 3, 4}) {
    const std::uint32_t value = 0xA1B2C3D4U >> (8 * (4 - size));
    const SdoMessage reply = decode_sdo_reply(sdo_read_reply(5, {0x6079, 0}, value, size));
    EXPECT_EQ(reply.kind, SdoKind::kUpload);
    EXPECT_EQ(reply.value, value);
    EXPECT_EQ(reply.size, size);
  }
  EXPECT_EQ(decode_sdo_reply(sdo_write_reply(5, {0x1017, 0})).kind, SdoKind::kDownload);
  const SdoMessage abort = decode_sdo_reply(sdo_server_abort(5, {0x1017, 0}, kAbortNoObject));
  EXPECT_EQ(abort.kind, SdoKind::kAbort);
  EXPECT_EQ(abort.value, kAbortNoObject);
}

TEST(SdoFrames, ExpeditedWithoutToldSizeCarriesFourBytes) {
  const SdoMessage write = decode_sdo_request(
      with_command(sdo_write_request(1, {0x1017, 0}, 0x01020304, 4), 0x22));
  EXPECT_EQ(write.kind, SdoKind::kDownload);
  EXPECT_EQ(write.size, 0);
  EXPECT_EQ(write.value, 0x01020304U);
  const SdoMessage reply = decode_sdo_reply(
      with_command(sdo_read_reply(1, {0x1017, 0}, 0x01020304, 4), 0x42));
  EXPECT_EQ(reply.kind, SdoKind::kUpload);
  EXPECT_EQ(reply.size, 0);
  EXPECT_EQ(reply.value, 0x01020304U);
}

TEST(SdoFrames, BeginningOfASegmentedTransferTellsItsSizeOrNot) {
  const CanFrame write = sdo_write_begin(5, {0x1F50, 1}, 300),
                 read = sdo_read_begin_reply(5, {0x1F50, 1}, 300);
  for (const SdoMessage& told : {decode_sdo_request(write), decode_sdo_reply(read)}) {
    EXPECT_EQ(told.object, (ObjectId{0x1F50, 1}));
    EXPECT_EQ(told.value, 300U);
    EXPECT_EQ(told.size, 4);
  }
  EXPECT_EQ(decode_sdo_request(write).kind, SdoKind::kDownloadBegin);
  EXPECT_EQ(decode_sdo_reply(read).kind, SdoKind::kUploadBegin);
  for (const SdoMessage& untold :
       {decode_sdo_request(with_command(write, 0x20)), decode_sdo_reply(with_command(read, 0x40))}) {
    EXPECT_EQ(untold.value, 0U);
    EXPECT_EQ(untold.size, 0);
  }
}

TEST(SdoFrames, SegmentsKeepToggleLengthAndEnd) {
  const std::uint8_t text[7] = {1, 2, 3, 4, 5, 6, 7};
  for (int count = 0; count <= 7; ++count) {
    for (const bool toggle : {false, true}) {
      for (const bool last : {false, true}) {
        const SdoMessage down = decode_sdo_request(sdo_write_segment(5, toggle, text, count, last));
        const SdoMessage up = decode_sdo_reply(sdo_read_segment_reply(5, toggle, text, count, last));
        EXPECT_EQ(down.kind, SdoKind::kDownloadSegment);
        EXPECT_EQ(up.kind, SdoKind::kUploadSegment);
        for (const SdoMessage& found : {down, up}) {
          EXPECT_EQ(found.size, count);
          EXPECT_EQ(found.toggle, toggle);
          EXPECT_EQ(found.last, last);
        }
      }
    }
  }
  for (const bool toggle : {false, true}) {
    EXPECT_EQ(decode_sdo_request(sdo_read_segment_request(5, toggle)).kind, SdoKind::kUploadSegment);
    EXPECT_EQ(decode_sdo_request(sdo_read_segment_request(5, toggle)).toggle, toggle);
    EXPECT_EQ(decode_sdo_reply(sdo_write_segment_reply(5, toggle)).kind, SdoKind::kDownloadSegment);
    EXPECT_EQ(decode_sdo_reply(sdo_write_segment_reply(5, toggle)).toggle, toggle);
  }
}

// Block frames of CiA 301 7.2.4.3.9 to 7.2.4.3.16, typed by hand.
TEST(SdoFrames, BlockFramesHaveTheBytesOfTheStandard) {
  EXPECT_EQ(bytes(sdo_block_read_request(5, {0x1008, 2}, 28)), (Bytes{0xA4, 0x08, 0x10, 2, 127, 28, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_read_begin(5, {0x1008, 2}, 300)), (Bytes{0xC6, 0x08, 0x10, 2, 0x2C, 1, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_read_start(5)), (Bytes{0xA3, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_read_ack(5, 43)), (Bytes{0xA2, 43, 127, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_read_end(5, 1, 0x31C3)), (Bytes{0xC5, 0xC3, 0x31, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_read_taken(5)), (Bytes{0xA1, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_write_begin(5, {0x1008, 2}, 300)), (Bytes{0xC6, 0x08, 0x10, 2, 0x2C, 1, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_write_reply(5, {0x1008, 2})), (Bytes{0xA4, 0x08, 0x10, 2, 127, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_write_ack(5, 43)), (Bytes{0xA2, 43, 127, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_write_end(5, 7, 0xBEEF)), (Bytes{0xDD, 0xEF, 0xBE, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_block_write_taken(5)), (Bytes{0xA1, 0, 0, 0, 0, 0, 0, 0}));
  const std::uint8_t text[] = {1, 2, 3};
  EXPECT_EQ(bytes(sdo_block_segment(sdo_client_id(5), 127, text, 3, true)),
            (Bytes{0xFF, 1, 2, 3, 0, 0, 0, 0}));
}

TEST(SdoFrames, BlockFramesAreUnderstoodByTheOtherSide) {
  const SdoMessage read = decode_sdo_request(sdo_block_read_request(5, {0x1008, 2}, 28));
  EXPECT_EQ(read.kind, SdoKind::kBlockUploadBegin);
  EXPECT_EQ(read.object, (ObjectId{0x1008, 2}));
  EXPECT_EQ(read.block.size, kMaxBlock);
  EXPECT_EQ(read.block.threshold, 28);
  EXPECT_TRUE(read.block.with_crc);
  const SdoMessage begun = decode_sdo_reply(sdo_block_read_begin(5, {0x1008, 2}, 300));
  EXPECT_EQ(begun.kind, SdoKind::kBlockUploadBegin);
  EXPECT_EQ(begun.value, 300U);
  EXPECT_TRUE(begun.block.with_crc);
  EXPECT_EQ(decode_sdo_request(sdo_block_read_start(5)).kind, SdoKind::kBlockUploadStart);
  const SdoMessage ack = decode_sdo_request(sdo_block_read_ack(5, 43));
  EXPECT_EQ(ack.kind, SdoKind::kBlockUploadAck);
  EXPECT_EQ(ack.block.acknowledged, 43);
  const SdoMessage end = decode_sdo_reply(sdo_block_read_end(5, 6, 0x31C3));
  EXPECT_EQ(end.kind, SdoKind::kBlockUploadEnd);
  EXPECT_EQ(end.block.unused, 6);
  EXPECT_EQ(end.block.crc, 0x31C3);
  EXPECT_EQ(decode_sdo_request(sdo_block_read_taken(5)).kind, SdoKind::kBlockUploadEnd);
  EXPECT_EQ(decode_sdo_request(sdo_block_write_begin(5, {1, 2}, 9)).kind, SdoKind::kBlockDownloadBegin);
  EXPECT_EQ(decode_sdo_reply(sdo_block_write_reply(5, {1, 2})).kind, SdoKind::kBlockDownloadBegin);
  EXPECT_EQ(decode_sdo_reply(sdo_block_write_ack(5, 1)).kind, SdoKind::kBlockDownloadAck);
  EXPECT_EQ(decode_sdo_request(sdo_block_write_end(5, 1, 2)).kind, SdoKind::kBlockDownloadEnd);
  EXPECT_EQ(decode_sdo_reply(sdo_block_write_taken(5)).kind, SdoKind::kBlockDownloadEnd);
}

// 0xE0 is nothing; the others have bits set that must not be.
TEST(SdoFrames, UnknownCommandsAreUnsupportedAndKeepTheirObject) {
  for (const int command : {0xE0, 0xFF, 0xA8, 0xC8, 0x41, 0x62, 0x24, 0x81}) {
    const SdoMessage found = decode_sdo_request(with_command(sdo_read_request(1, {0x1008, 2}), command));
    EXPECT_EQ(found.kind, SdoKind::kUnsupported) << std::hex << command;
    EXPECT_EQ(found.object, (ObjectId{0x1008, 2})) << std::hex << command;
  }
}

TEST(SdoFrames, EveryCommandByteIsDecodedOneWayOrAnother) {
  for (int command = 0; command < 256; ++command) {
    const SdoMessage request = decode_sdo_request(with_command(sdo_read_request(1, {1, 2}), command));
    const SdoMessage reply = decode_sdo_reply(with_command(sdo_write_reply(1, {1, 2}), command));
    for (const SdoMessage& found : {request, reply}) {
      EXPECT_NE(found.kind, SdoKind::kInvalid) << command;
      EXPECT_GE(found.size, 0) << command;
      EXPECT_LE(found.size, 7) << command;
    }
  }
}

TEST(SdoFrames, ShortRemoteAndErrorFramesAreNone) {
  for (int kind = 0; kind < 3; ++kind) {
    CanFrame frame = sdo_read_request(1, {0x1008, 0});
    if (kind == 0) frame.length = 4;
    frame.remote = kind == 1;
    frame.error = kind == 2;
    EXPECT_EQ(decode_sdo_request(frame).kind, SdoKind::kInvalid) << kind;
    EXPECT_EQ(decode_sdo_reply(frame).kind, SdoKind::kInvalid) << kind;
  }
}

}  // namespace
}  // namespace sprung::canopen
