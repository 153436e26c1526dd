/// The bytes of MCAP, read back by a small reader of its own; tests/conformance reads them with Foxglove's.
#include "tools/logs/log/mcap_export.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <map>

#include "tests/tools/logs/log/proto_reader.h"
#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/log/checksum.h"

namespace sprung::log {
namespace {

struct Record {
  McapOp op;
  std::string content;
  std::size_t offset;
};

class Cursor {
 public:
  explicit Cursor(const std::string& bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {}
  template <class Unsigned>
  Unsigned number() {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      value = static_cast<Unsigned>(
          value | static_cast<Unsigned>(Unsigned{static_cast<std::uint8_t>(bytes_.at(at_ + i))} << (8 * i)));
    at_ += sizeof(Unsigned);
    return value;
  }
  std::string take(std::size_t size) {
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::string text() { return take(number<std::uint32_t>()); }
  std::string rest() { return take(bytes_.size() - at_); }
  std::size_t at() const { return at_; }
  bool done() const { return at_ >= bytes_.size(); }

 private:
  const std::string& bytes_;
  std::size_t at_;
};

std::vector<Record> records_of(const std::string& bytes, std::size_t from, std::size_t to) {
  std::vector<Record> records;
  for (Cursor cursor(bytes, from); cursor.at() < to;) {
    const std::size_t offset = cursor.at();
    const auto op = static_cast<McapOp>(cursor.number<std::uint8_t>());
    records.push_back({op, cursor.take(cursor.number<std::uint64_t>()), offset});
  }
  return records;
}

class McapTest : public testing::Test {
 protected:
  std::vector<Record> exported(const std::vector<Kept>& events, bool compress,
                               std::size_t chunk_bytes = 4096) {
    write_all(path_, events);
    Reader reader(path_);
    ChannelFilter all({});
    bytes_.clear();
    McapOptions options;
    options.compress = compress;
    options.chunk_bytes = chunk_bytes;
    McapWriter writer([this](std::string_view part) { bytes_ += part; }, "sprung test", options);
    result_ = export_mcap(reader, all, writer);
    writer.finish();
    EXPECT_EQ(writer.bytes(), bytes_.size());
    EXPECT_EQ(bytes_.substr(0, 8), kMcapMagic);
    EXPECT_EQ(bytes_.substr(bytes_.size() - 8), kMcapMagic);
    return records_of(bytes_, 8, bytes_.size() - 8);
  }

  std::string records_in(const Record& chunk) {
    Cursor cursor(chunk.content);
    cursor.number<std::uint64_t>();
    cursor.number<std::uint64_t>();
    const auto size = cursor.number<std::uint64_t>();
    cursor.number<std::uint32_t>();
    const std::string packing = cursor.text();
    const std::string packed = cursor.take(cursor.number<std::uint64_t>());
    if (packing.empty()) return packed;
    EXPECT_EQ(packing, "zstd");
    std::string plain(size, '\0');
    EXPECT_EQ(ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()), size);
    return plain;
  }

  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
  std::string bytes_;
  McapResult result_;
};

std::size_t count(const std::vector<Record>& records, McapOp op) {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(), [op](const Record& record) { return record.op == op; }));
}

TEST_F(McapTest, MessagesAreInTheOrderOfTheirLogTimesAndOfPublishTimesWithinEachTopic) {
  std::vector<Kept> events = robot_events(30);
  std::swap(events[20], events[31]);
  events[11].time_us += 9000;  // the network held it back: its topic's next ones were received earlier
  const std::int64_t held_back_us = events[11].time_us;
  std::vector<std::uint64_t> log_ns;
  std::map<std::uint16_t, std::vector<std::uint64_t>> published_ns;
  for (const Record& record : exported(events, false)) {
    if (record.op != McapOp::kChunk) continue;
    const std::string inner = records_in(record);
    for (const Record& message : records_of(inner, 0, inner.size())) {
      Cursor cursor(message.content);
      const auto topic = cursor.number<std::uint16_t>();
      cursor.take(4);
      log_ns.push_back(cursor.number<std::uint64_t>());
      published_ns[topic].push_back(cursor.number<std::uint64_t>());
    }
  }
  EXPECT_EQ(log_ns.size(), 63u);
  EXPECT_TRUE(std::is_sorted(log_ns.begin(), log_ns.end()));
  std::ptrdiff_t held_back = 0;
  for (const auto& [topic, times] : published_ns) {
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end())) << topic;
    held_back += std::count(times.begin(), times.end(), static_cast<std::uint64_t>(held_back_us) * 1000);
  }
  EXPECT_GT(held_back, 1) << "who came before it has its time";
}

TEST_F(McapTest, EveryMessageIsThereInProtocolBuffers) {
  for (const bool compress : {false, true}) {
    std::vector<std::int64_t> cycles;
    for (const Record& record : exported(robot_events(30), compress)) {
      if (record.op != McapOp::kChunk) continue;
      const std::string inner = records_in(record);
      for (const Record& message : records_of(inner, 0, inner.size())) {
        ASSERT_EQ(message.op, McapOp::kMessage);
        Cursor cursor(message.content);
        cursor.take(2 + 4 + 8 + 8);
        const std::string data = cursor.rest();
        if (proto_values(data, 6).size() == 2)  // joints
          cycles.push_back(static_cast<std::int64_t>(proto_values(data, 3)[0].number));
      }
    }
    ASSERT_EQ(cycles.size(), 30u);
    for (std::size_t k = 0; k < 30; ++k) EXPECT_EQ(cycles[k], static_cast<std::int64_t>(k));
    EXPECT_EQ(result_.written, 63);
  }
}

/// Chunks are compressed beside, whatever comes between them: every byte must be the same each time, and in
/// its place.
TEST_F(McapTest, TheFileIsTheSameEveryTime) {
  std::vector<Kept> events = robot_events(200);
  events.push_back(metadata_event());
  exported(events, true, 2000);
  const std::string once = bytes_;
  for (int i = 0; i < 10; ++i) {
    exported(events, true, 2000);
    ASSERT_EQ(bytes_, once);
  }
}

TEST_F(McapTest, AFullDiskIsToldWhoeverIsAtWork) {
  exported(robot_events(100), true, 2000);
  Reader reader(path_);
  ChannelFilter all({});
  McapOptions options;
  options.chunk_bytes = 2000;
  std::size_t room = bytes_.size() / 2;
  McapWriter writer(
      [&room](std::string_view part) {
        if (part.size() > room) throw std::runtime_error("no room");
        room -= part.size();
      },
      "sprung test", options);
  EXPECT_THROW(export_mcap(reader, all, writer), std::runtime_error);
}

TEST_F(McapTest, TimesAreTheRobotsAndWhenItWasReceived) {
  std::vector<Kept> events{joint_event(0), joint_event(1)};
  events[1].time_us += 40'000;
  const auto records = exported(events, false);
  for (const Record& record : records) {
    if (record.op != McapOp::kChunk) continue;
    const std::string inner = records_in(record);
    const auto messages = records_of(inner, 0, inner.size());
    ASSERT_EQ(messages.size(), 2u);
    Cursor cursor(messages[1].content);
    cursor.number<std::uint16_t>();
    EXPECT_EQ(cursor.number<std::uint32_t>(), 1u);
    EXPECT_EQ(cursor.number<std::uint64_t>(),
              static_cast<std::uint64_t>(kSampleBegin_us + 300 + 2000) * 1000);
    EXPECT_EQ(cursor.number<std::uint64_t>(), static_cast<std::uint64_t>(events[1].time_us) * 1000);
  }
}

TEST_F(McapTest, TheIndexLeadsToEveryMessage) {
  const auto records = exported(robot_events(60), true);
  EXPECT_GT(count(records, McapOp::kChunk), 3u);
  EXPECT_EQ(count(records, McapOp::kChunkIndex), count(records, McapOp::kChunk));
  std::size_t found = 0;
  for (const Record& record : records) {
    if (record.op != McapOp::kChunkIndex) continue;
    Cursor index(record.content);
    index.take(16);
    const auto offset = index.number<std::uint64_t>();
    const auto length = index.number<std::uint64_t>();
    const auto chunk = records_of(bytes_, offset, offset + length);
    ASSERT_EQ(chunk.size(), 1u);
    ASSERT_EQ(chunk[0].op, McapOp::kChunk);
    const std::string inner = records_in(chunk[0]);
    const std::string offsets = index.text();
    for (Cursor each(offsets); !each.done();) {
      const auto channel = each.number<std::uint16_t>();
      const auto at = each.number<std::uint64_t>();
      Cursor entry(bytes_, at + 9);
      EXPECT_EQ(static_cast<McapOp>(bytes_[at]), McapOp::kMessageIndex);
      EXPECT_EQ(entry.number<std::uint16_t>(), channel);
      const std::string pairs = entry.text();
      for (Cursor pair(pairs); !pair.done(); ++found) {
        const auto time_ns = pair.number<std::uint64_t>();
        Cursor message(inner, pair.number<std::uint64_t>() + 9);
        EXPECT_EQ(message.number<std::uint16_t>(), channel);
        message.number<std::uint32_t>();
        EXPECT_EQ(message.number<std::uint64_t>(), time_ns);
      }
    }
  }
  EXPECT_EQ(found, 1u + 120u + 1u + 1u);
}

TEST_F(McapTest, ProtobufSchemasHaveTheirFullName) {
  for (const Record& record : exported(robot_events(5), true)) {
    if (record.op == McapOp::kChannel) {
      Cursor cursor(record.content);
      cursor.take(2 + 2);
      cursor.text();
      EXPECT_EQ(cursor.text(), "protobuf");
    }
    if (record.op != McapOp::kSchema) continue;
    Cursor cursor(record.content);
    cursor.number<std::uint16_t>();
    const std::string name = cursor.text();
    EXPECT_EQ(cursor.text(), "protobuf");
    const std::string last_file = proto_values(cursor.text()).back().bytes;
    EXPECT_EQ(name, "sprung_msgs." + proto_bytes(proto_bytes(last_file, 4), 1));
  }
}

TEST_F(McapTest, ASchemaIsWrittenOnceAChannelForEachTopic) {
  const auto records = exported(robot_events(5), true);
  EXPECT_EQ(count(records, McapOp::kSchema), 2 * 5u);  // in front of the messages, and in the summary
  EXPECT_EQ(count(records, McapOp::kChannel), 2 * 5u);
  for (const Record& record : records) {
    if (record.op != McapOp::kSchema) continue;
    EXPECT_GT(Cursor(record.content).number<std::uint16_t>(), 0) << "0 stands for none";
  }
}

TEST_F(McapTest, MetadataAndRobotFileComeAlong) {
  const auto records = exported(robot_events(5), true);
  EXPECT_EQ(count(records, McapOp::kMetadata), 1u);
  EXPECT_EQ(count(records, McapOp::kMetadataIndex), 1u);
  EXPECT_EQ(count(records, McapOp::kAttachmentIndex), 1u);
  for (const Record& record : records) {
    if (record.op != McapOp::kAttachment) continue;
    EXPECT_NE(record.content.find("name: no_such_robot\n"), std::string::npos);
  }
}

TEST_F(McapTest, TheFooterLeadsToTheSummary) {
  const auto records = exported(robot_events(5), true);
  ASSERT_EQ(records.back().op, McapOp::kFooter);
  Cursor footer(records.back().content);
  const auto summary = footer.number<std::uint64_t>();
  const auto offsets = footer.number<std::uint64_t>();
  EXPECT_EQ(records_of(bytes_, summary, offsets)[0].op, McapOp::kSchema);
  for (const Record& record : records_of(bytes_, offsets, records.back().offset)) {
    EXPECT_EQ(record.op, McapOp::kSummaryOffset);
    Cursor cursor(record.content);
    const auto op = static_cast<McapOp>(cursor.number<std::uint8_t>());
    const auto begin = cursor.number<std::uint64_t>();
    for (const Record& member : records_of(bytes_, begin, begin + cursor.number<std::uint64_t>()))
      EXPECT_EQ(member.op, op);
  }
}

TEST_F(McapTest, EveryChunkHasTheChecksumOfItsRecords) {
  for (const bool compress : {false, true}) {
    std::size_t chunks = 0;
    for (const Record& record : exported(robot_events(60), compress)) {
      if (record.op != McapOp::kChunk) continue;
      Cursor cursor(record.content);
      cursor.take(8 + 8 + 8);
      EXPECT_EQ(cursor.number<std::uint32_t>(), checksum(records_in(record)));
      ++chunks;
    }
    EXPECT_GT(chunks, 1u);
  }
}

TEST_F(McapTest, AnAttachmentHasTheChecksumOfItsFields) {
  for (const Record& record : exported(robot_events(5), true)) {
    if (record.op != McapOp::kAttachment) continue;
    const std::size_t fields = record.content.size() - 4;
    EXPECT_EQ(Cursor(record.content, fields).number<std::uint32_t>(),
              checksum(record.content.substr(0, fields)));
  }
}

TEST_F(McapTest, DataAndSummaryHaveChecksums) {
  const auto records = exported(robot_events(60), true);
  for (const Record& record : records) {
    if (record.op != McapOp::kDataEnd) continue;
    EXPECT_EQ(Cursor(record.content).number<std::uint32_t>(), checksum(bytes_.substr(0, record.offset)));
  }
  ASSERT_EQ(count(records, McapOp::kDataEnd), 1u);
  Cursor footer(records.back().content);
  const auto summary = footer.number<std::uint64_t>();
  footer.number<std::uint64_t>();
  const std::size_t end = bytes_.size() - kMcapMagic.size() - 4;  // all of the footer but the checksum itself
  EXPECT_EQ(footer.number<std::uint32_t>(), checksum(bytes_.substr(summary, end - summary)));
}

TEST_F(McapTest, WhatNobodyKnowsIsLeftOutAndCounted) {
  exported({{0, 1, "CAMERA", std::string(50, 'x')}, joint_event(0)}, true);
  EXPECT_EQ(result_.not_decoded, 1);
  EXPECT_EQ(result_.written, 1);
}

TEST_F(McapTest, AnEmptyLogIsAnEmptyFile) {
  const auto records = exported({}, true);
  EXPECT_EQ(count(records, McapOp::kChunk), 0u);
  EXPECT_EQ(count(records, McapOp::kStatistics), 1u);
}

}  // namespace
}  // namespace sprung::log
