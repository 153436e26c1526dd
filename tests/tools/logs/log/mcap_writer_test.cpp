#include "tools/logs/log/mcap_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sprung::log {
namespace {

constexpr std::size_t kHeadBytes = 1 + 8;  ///< operation and length

/// Operations of all records between both magics, in order.
std::vector<McapOp> operations_of(const std::string& file) {
  std::vector<McapOp> found;
  for (std::size_t at = kMcapMagic.size(); at + kHeadBytes <= file.size() - kMcapMagic.size();) {
    found.push_back(static_cast<McapOp>(file[at]));
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 8; ++i)
      length |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(file[at + 1 + i])) << (8 * i);
    at += kHeadBytes + length;
  }
  return found;
}

class McapWriterTest : public testing::Test {
 protected:
  McapWriter begin(std::size_t chunk_bytes, bool compress = false) {
    McapOptions options;
    options.chunk_bytes = chunk_bytes;
    options.compress = compress;
    return McapWriter([this](std::string_view part) { file_ += part; }, "test", options);
  }
  static void add_messages(McapWriter& writer, int count) {
    const std::uint16_t channel = writer.add_channel(writer.add_schema("name", "text", ""), "TOPIC", "text");
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      writer.add_message(channel, number, 1000 + number, 2000 + number, "payload");
    }
  }
  long count(McapOp op) const {
    const std::vector<McapOp> all = operations_of(file_);
    return std::count(all.begin(), all.end(), op);
  }

  std::string file_;
};

TEST_F(McapWriterTest, NumbersAreLittleEndian) {
  std::string bytes;
  append_little_endian(std::uint32_t{0x01020304}, bytes);
  EXPECT_EQ(bytes, "\x04\x03\x02\x01");
}

TEST_F(McapWriterTest, AFileBeginsWithItsHeaderAndEndsWithItsFooter) {
  McapWriter writer = begin(1000);
  writer.finish();
  EXPECT_EQ(file_.substr(0, kMcapMagic.size()), kMcapMagic);
  EXPECT_EQ(file_.substr(file_.size() - kMcapMagic.size()), kMcapMagic);
  EXPECT_EQ(operations_of(file_).front(), McapOp::kHeader);
  EXPECT_EQ(operations_of(file_).back(), McapOp::kFooter);
  EXPECT_EQ(writer.bytes(), file_.size());
}

TEST_F(McapWriterTest, AChunkIsClosedWhenItIsFull) {
  const std::size_t message_bytes = kHeadBytes + 2 + 4 + 8 + 8 + std::string("payload").size();
  McapWriter writer = begin(2 * message_bytes);
  add_messages(writer, 5);
  writer.finish();
  EXPECT_EQ(writer.messages(), 5u);
  EXPECT_EQ(count(McapOp::kChunk), 3);
  EXPECT_EQ(count(McapOp::kChunkIndex), 3);
  EXPECT_EQ(count(McapOp::kMessageIndex), 3);
}

TEST_F(McapWriterTest, WhatIsNotCompressedStandsThereAsItIs) {
  McapWriter writer = begin(1000);
  add_messages(writer, 1);
  writer.finish();
  std::string message;
  append_message({0, 0, 1000, 2000}, "payload", message);
  EXPECT_NE(file_.find(message), std::string::npos);
}

TEST_F(McapWriterTest, CompressedMessagesAreFewerBytes) {
  McapWriter plain = begin(100'000);
  add_messages(plain, 1000);
  plain.finish();
  file_.clear();
  McapWriter packed = begin(100'000, true);
  add_messages(packed, 1000);
  packed.finish();
  EXPECT_LT(packed.bytes(), plain.bytes() / 2);
  EXPECT_EQ(packed.messages(), plain.messages());
}

TEST_F(McapWriterTest, MetadataAndAttachmentsAreIndexed) {
  McapWriter writer = begin(1000);
  writer.add_metadata("robot", {{"name", "pegasus"}});
  writer.add_attachment(5, "robot.yaml", "text/yaml", "name: pegasus");
  writer.finish();
  EXPECT_EQ(count(McapOp::kMetadata), 1);
  EXPECT_EQ(count(McapOp::kMetadataIndex), 1);
  EXPECT_EQ(count(McapOp::kAttachment), 1);
  EXPECT_EQ(count(McapOp::kAttachmentIndex), 1);
}

}  // namespace
}  // namespace sprung::log
