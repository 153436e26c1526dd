#include "tools/log/mcap_writer.h"

#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace sprung::log {

namespace {

constexpr std::uint32_t kNoChecksum = 0;  // what the format says where there is none
constexpr int kFastZstd = 1;

void compress(const std::string& from, std::string& to) {
  to.resize(ZSTD_compressBound(from.size()));
  const std::size_t size = ZSTD_compress(to.data(), to.size(), from.data(), from.size(), kFastZstd);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  to.resize(size);
}

}  // namespace

void McapWriter::Span::add(std::uint64_t time_ns, bool first) noexcept {
  first_ns = first ? time_ns : std::min(first_ns, time_ns);
  last_ns = first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(Sink sink, const std::string& library, const McapOptions& options)
    : sink_(std::move(sink)), options_(options) {
  sink_(kMcapMagic);
  position_ = kMcapMagic.size();
  put(McapOp::kHeader, McapFields().text("").text(library).bytes());
}

void McapWriter::put(McapOp op, std::string_view content) {
  std::string record;
  append_record(op, content, record);
  sink_(record);
  position_ += record.size();
}

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding,
                                     const std::string& text) {
  const std::uint16_t id = ++schemas_;  // 0 means that there is none
  const std::string content = McapFields().number(id).text(name).text(encoding).text(text).bytes();
  put(McapOp::kSchema, content);
  append_record(McapOp::kSchema, content, schema_records_);
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic,
                                      const std::string& message_encoding) {
  const std::uint16_t id = channels_++;
  const std::string content =
      McapFields().number(id).number(schema).text(topic).text(message_encoding).texts({}).bytes();
  put(McapOp::kChannel, content);
  append_record(McapOp::kChannel, content, channel_records_);
  return id;
}

void McapWriter::add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns,
                             std::uint64_t publish_ns, std::string_view data) {
  chunk_index_[channel].push_back({log_ns, chunk_.size()});
  fields_.clear();
  fields_.number(channel).number(sequence).number(log_ns).number(publish_ns).raw(data);
  append_record(McapOp::kMessage, fields_.bytes(), chunk_);
  chunk_span_.add(log_ns, chunk_messages_++ == 0);
  span_.add(log_ns, message_count_++ == 0);
  ++counts_[channel];
  if (chunk_.size() >= options_.chunk_bytes) close_chunk();
}

void McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& values) {
  const std::uint64_t begin = position_;
  put(McapOp::kMetadata, McapFields().text(name).texts(values).bytes());
  append_record(McapOp::kMetadataIndex,
                McapFields().number(begin).number(position_ - begin).text(name).bytes(), metadata_indices_);
  ++metadata_count_;
}

void McapWriter::add_attachment(std::uint64_t log_ns, const std::string& name, const std::string& media_type,
                                std::string_view data) {
  const std::uint64_t begin = position_;
  const auto size = static_cast<std::uint64_t>(data.size());
  put(McapOp::kAttachment, McapFields()
                               .number(log_ns)
                               .number(log_ns)
                               .text(name)
                               .text(media_type)
                               .number(size)
                               .raw(data)
                               .number(kNoChecksum)
                               .bytes());
  append_record(McapOp::kAttachmentIndex,
                McapFields()
                    .number(begin)
                    .number(position_ - begin)
                    .number(log_ns)
                    .number(log_ns)
                    .number(size)
                    .text(name)
                    .text(media_type)
                    .bytes(),
                attachment_indices_);
  ++attachment_count_;
}

/// @param offsets receives where each channel's index is, as a chunk index says it. @return bytes of all indices.
std::uint64_t McapWriter::write_message_indices(McapFields& offsets) {
  const std::uint64_t begin = position_;
  for (auto& [channel, entries] : chunk_index_) {
    if (entries.empty()) continue;
    offsets.number(channel).number(position_);
    McapFields pairs;
    for (const IndexEntry& entry : entries) pairs.number(entry.time_ns).number(entry.offset);
    put(McapOp::kMessageIndex, McapFields().number(channel).text(pairs.bytes()).bytes());
    entries.clear();
  }
  return position_ - begin;
}

void McapWriter::close_chunk() {
  if (chunk_messages_ == 0) return;
  if (options_.compress) compress(chunk_, packed_);
  const std::string& records = options_.compress ? packed_ : chunk_;
  const std::string_view packing = options_.compress ? "zstd" : "";
  const auto plain_size = static_cast<std::uint64_t>(chunk_.size());
  const auto size = static_cast<std::uint64_t>(records.size());
  const std::uint64_t begin = position_;
  McapFields chunk;
  chunk.number(chunk_span_.first_ns).number(chunk_span_.last_ns).number(plain_size).number(kNoChecksum);
  put(McapOp::kChunk, chunk.text(packing).number(size).raw(records).bytes());
  const std::uint64_t length = position_ - begin;
  McapFields offsets;
  const std::uint64_t index_length = write_message_indices(offsets);
  McapFields index;
  index.number(chunk_span_.first_ns).number(chunk_span_.last_ns).number(begin).number(length);
  index.text(offsets.bytes()).number(index_length).text(packing).number(size).number(plain_size);
  append_record(McapOp::kChunkIndex, index.bytes(), chunk_indices_);
  ++chunk_count_;
  chunk_.clear();
  chunk_messages_ = 0;
}

std::string McapWriter::statistics() const {
  McapFields counts;
  for (const auto& [channel, count] : counts_) counts.number(channel).number(count);
  std::string record;
  append_record(McapOp::kStatistics,
                McapFields()
                    .number(message_count_)
                    .number(schemas_)
                    .number(static_cast<std::uint32_t>(channels_))
                    .number(attachment_count_)
                    .number(metadata_count_)
                    .number(chunk_count_)
                    .number(span_.first_ns)
                    .number(span_.last_ns)
                    .text(counts.bytes())
                    .bytes(),
                record);
  return record;
}

/// @param offsets receives where the group is.
void McapWriter::write_group(McapOp op, const std::string& records, std::string& offsets) {
  if (records.empty()) return;
  append_record(McapOp::kSummaryOffset,
                McapFields()
                    .number(static_cast<std::uint8_t>(op))
                    .number(position_)
                    .number(static_cast<std::uint64_t>(records.size()))
                    .bytes(),
                offsets);
  sink_(records);
  position_ += records.size();
}

void McapWriter::write_summary() {
  const std::uint64_t summary = position_;
  std::string offsets;
  write_group(McapOp::kSchema, schema_records_, offsets);
  write_group(McapOp::kChannel, channel_records_, offsets);
  write_group(McapOp::kStatistics, statistics(), offsets);
  write_group(McapOp::kChunkIndex, chunk_indices_, offsets);
  write_group(McapOp::kAttachmentIndex, attachment_indices_, offsets);
  write_group(McapOp::kMetadataIndex, metadata_indices_, offsets);
  const std::uint64_t summary_offsets = position_;
  sink_(offsets);
  position_ += offsets.size();
  put(McapOp::kFooter, McapFields().number(summary).number(summary_offsets).number(kNoChecksum).bytes());
}

void McapWriter::finish() {
  close_chunk();
  put(McapOp::kDataEnd, McapFields().number(kNoChecksum).bytes());
  write_summary();
  sink_(kMcapMagic);
  position_ += kMcapMagic.size();
}

}  // namespace sprung::log
