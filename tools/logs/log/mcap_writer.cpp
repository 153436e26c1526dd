#include "tools/logs/log/mcap_writer.h"

#include <algorithm>
#include <utility>

#include "tools/logs/log/checksum.h"

namespace sprung::log {

void McapWriter::Span::add(std::uint64_t time_ns, bool first) noexcept {
  first_ns = first ? time_ns : std::min(first_ns, time_ns);
  last_ns = first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(Sink sink, const std::string& library, const McapOptions& options)
    : sink_(std::move(sink)), options_(options), packer_(options.zstd_level) {
  send(kMcapMagic);
  put(McapOp::kHeader, McapFields().text("").text(library).bytes());
}

void McapWriter::send(std::string_view bytes) {
  sink_(bytes);
  position_ += bytes.size();
  section_checksum_ = checksum(bytes, section_checksum_);
}

void McapWriter::put(McapOp op, std::string_view content) {
  std::string record;
  append_record(op, content, record);
  send(record);
}

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding,
                                     const std::string& text) {
  settle();
  const std::uint16_t id = ++schemas_;  // 0 means that there is none
  const std::string content = McapFields().number(id).text(name).text(encoding).text(text).bytes();
  put(McapOp::kSchema, content);
  append_record(McapOp::kSchema, content, schema_records_);
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic,
                                      const std::string& message_encoding) {
  settle();
  const std::uint16_t id = channels_++;
  const std::string
      content = McapFields().number(id).number(schema).text(topic).text(message_encoding).texts({}).bytes();
  put(McapOp::kChannel, content);
  append_record(McapOp::kChannel, content, channel_records_);
  return id;
}

void McapWriter::add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns,
                             std::uint64_t publish_ns, std::string_view data) {
  filling_.index[channel].push_back({log_ns, filling_.records.size()});
  append_message({channel, sequence, log_ns, publish_ns}, data, filling_.records);
  filling_.span.add(log_ns, filling_.messages++ == 0);
  span_.add(log_ns, message_count_++ == 0);
  ++counts_[channel];
  if (filling_.records.size() >= options_.chunk_bytes) close_chunk();
}

void McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& values) {
  settle();
  const std::uint64_t begin = position_;
  put(McapOp::kMetadata, McapFields().text(name).texts(values).bytes());
  append_record(McapOp::kMetadataIndex,
                McapFields().number(begin).number(position_ - begin).text(name).bytes(), metadata_indices_);
  ++metadata_count_;
}

void McapWriter::add_attachment(std::uint64_t log_ns, const std::string& name, const std::string& media_type,
                                std::string_view data) {
  settle();
  const std::uint64_t begin = position_;
  const auto size = static_cast<std::uint64_t>(data.size());
  McapFields content;
  content.number(log_ns).number(log_ns).text(name).text(media_type).number(size).raw(data);
  put(McapOp::kAttachment, content.number(checksum(content.bytes())).bytes());
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

/// @param offsets receives where each channel's index is, as a chunk index says it. @return bytes of all
/// indices.
std::uint64_t McapWriter::write_message_indices(Chunk& chunk, McapFields& offsets) {
  const std::uint64_t begin = position_;
  for (auto& [channel, entries] : chunk.index) {
    if (entries.empty()) continue;
    offsets.number(channel).number(position_);
    McapFields pairs;
    for (const IndexEntry& entry : entries) pairs.number(entry.time_ns).number(entry.offset);
    put(McapOp::kMessageIndex, McapFields().number(channel).text(pairs.bytes()).bytes());
    entries.clear();
  }
  return position_ - begin;
}

/// The chunk that is full goes to the packer, once the one before it is written: the order of records depends
/// on nothing else.
void McapWriter::close_chunk() {
  settle();
  if (filling_.messages == 0) return;
  if (!options_.compress) return write_chunk(filling_, "", {filling_.records, checksum(filling_.records)});
  std::swap(filling_, packing_);
  packer_.begin(packing_.records);
}

/// Writes the chunk that the packer is at, so that something else may follow it.
void McapWriter::settle() {
  if (packing_.messages > 0) write_chunk(packing_, "zstd", packer_.finish());
}

/// Empties the chunk.
void McapWriter::write_chunk(Chunk& chunk, std::string_view packing, const PackedChunk& packed) {
  const auto plain_size = static_cast<std::uint64_t>(chunk.records.size());
  const auto size = static_cast<std::uint64_t>(packed.bytes.size());
  const std::uint64_t begin = position_;
  McapFields content;
  content.number(chunk.span.first_ns).number(chunk.span.last_ns).number(plain_size);
  content.number(packed.plain_checksum);
  put(McapOp::kChunk, content.text(packing).number(size).raw(packed.bytes).bytes());
  const std::uint64_t length = position_ - begin;
  McapFields offsets;
  const std::uint64_t index_length = write_message_indices(chunk, offsets);
  McapFields index;
  index.number(chunk.span.first_ns).number(chunk.span.last_ns).number(begin).number(length);
  index.text(offsets.bytes()).number(index_length).text(packing).number(size).number(plain_size);
  append_record(McapOp::kChunkIndex, index.bytes(), chunk_indices_);
  ++chunk_count_;
  chunk.records.clear();
  chunk.messages = 0;
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
  send(records);
}

void McapWriter::write_summary() {
  const std::uint64_t summary = position_;
  section_checksum_ = 0;
  std::string offsets;
  write_group(McapOp::kSchema, schema_records_, offsets);
  write_group(McapOp::kChannel, channel_records_, offsets);
  write_group(McapOp::kStatistics, statistics(), offsets);
  write_group(McapOp::kChunkIndex, chunk_indices_, offsets);
  write_group(McapOp::kAttachmentIndex, attachment_indices_, offsets);
  write_group(McapOp::kMetadataIndex, metadata_indices_, offsets);
  const std::uint64_t summary_offsets = position_;
  send(offsets);
  write_footer(summary, summary_offsets);
}

/// Its checksum covers the summary and what stands in front of itself in the footer.
void McapWriter::write_footer(std::uint64_t summary, std::uint64_t summary_offsets) {
  constexpr std::size_t kContentBytes = 8 + 8 + 4;
  std::string record;
  append_record_head(McapOp::kFooter, kContentBytes, record);
  append_little_endian(summary, record);
  append_little_endian(summary_offsets, record);
  append_little_endian(checksum(record, section_checksum_), record);
  send(record);
}

void McapWriter::finish() {
  close_chunk();
  settle();
  put(McapOp::kDataEnd, McapFields().number(section_checksum_).bytes());
  write_summary();
  send(kMcapMagic);
}

}  // namespace sprung::log
