#pragma once
/// Writes MCAP files: schemas, channels, messages in chunks with an index, so that Foxglove and PlotJuggler
/// open them and jump to any time; with checksums, so that they notice damage. Bytes go to a function, called
/// by the caller's own thread; one chunk is compressed in another while the next one fills. The bytes are the
/// same whichever is faster.
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/log/chunk_packer.h"

namespace sprung::log {

// Records of the format (mcap.dev/spec, version 0), as bytes. Everything is little endian.

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// First byte of a record.
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

template <class Unsigned>
void append_little_endian(Unsigned value, std::string& out) {
  char bytes[sizeof(Unsigned)];
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes[i] = static_cast<char>((value >> (8 * i)) & 0xFF);
  out.append(bytes, sizeof bytes);
}

/// The content of one record, put together field by field.
class McapFields {
 public:
  template <class Unsigned>
  McapFields& number(Unsigned value) {
    append_little_endian(value, bytes_);
    return *this;
  }
  McapFields& text(std::string_view value) {  ///< length (4 bytes) and text
    number(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }
  McapFields& raw(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  McapFields& texts(const std::map<std::string, std::string>& values) {  ///< length in bytes (4), then pairs
    McapFields pairs;
    for (const auto& [key, value] : values) pairs.text(key).text(value);
    return text(pairs.bytes_);
  }
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

/// What stands before a record's content.
inline void append_record_head(McapOp op, std::size_t content_bytes, std::string& out) {
  out += static_cast<char>(op);
  append_little_endian(static_cast<std::uint64_t>(content_bytes), out);
}

/// Appends the record: operation, length (8 bytes), content.
inline void append_record(McapOp op, std::string_view content, std::string& out) {
  append_record_head(op, content.size(), out);
  out += content;
}

struct McapMessageHead {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;  ///< since 1970, like the next
  std::uint64_t publish_ns = 0;
};

/// Appends a message's record, without a copy in between.
inline void append_message(const McapMessageHead& head, std::string_view data, std::string& out) {
  append_record_head(McapOp::kMessage, 2 + 4 + 8 + 8 + data.size(), out);
  append_little_endian(head.channel, out);
  append_little_endian(head.sequence, out);
  append_little_endian(head.log_ns, out);
  append_little_endian(head.publish_ns, out);
  out += data;
}

struct McapOptions {
  std::size_t chunk_bytes = std::size_t{2}
                            << 20;  ///< a chunk is closed when its messages are as large as this
  bool compress = true;             ///< chunks with zstd
  int zstd_level = -1;              ///< on logs of pegasus a fifth faster than level 1, and 3 % larger
};

class McapWriter {
 public:
  using Sink = std::function<void(std::string_view bytes)>;

  McapWriter(Sink sink, const std::string& library, const McapOptions& options = {});

  std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& text);
  std::uint16_t add_channel(std::uint16_t schema, const std::string& topic,
                            const std::string& message_encoding);
  /// @param log_ns, publish_ns since 1970.
  void add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns,
                   std::uint64_t publish_ns, std::string_view data);
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& values);
  void add_attachment(std::uint64_t log_ns, const std::string& name, const std::string& media_type,
                      std::string_view data);
  void finish();  ///< the last chunk, the index, the end; nothing may be added any more

  std::uint64_t messages() const noexcept { return message_count_; }
  std::uint64_t bytes() const noexcept { return position_; }

 private:
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    void add(std::uint64_t time_ns, bool first) noexcept;
  };
  struct IndexEntry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  ///< in the chunk's records
  };

  struct Chunk {
    std::string records;
    Span span;
    std::uint64_t messages = 0;
    std::map<std::uint16_t, std::vector<IndexEntry>> index;  ///< by channel
  };

  void send(std::string_view bytes);
  void put(McapOp op, std::string_view content);
  void close_chunk();
  void settle();
  void write_chunk(Chunk& chunk, std::string_view packing, const PackedChunk& packed);
  std::uint64_t write_message_indices(Chunk& chunk, McapFields& offsets);
  void write_summary();
  void write_footer(std::uint64_t summary, std::uint64_t summary_offsets);
  void write_group(McapOp op, const std::string& records, std::string& offsets);
  std::string statistics() const;

  Sink sink_;
  McapOptions options_;
  std::uint64_t position_ = 0;
  std::uint32_t section_checksum_ = 0;  ///< of the section at hand: the data's, then the summary's
  std::uint16_t schemas_ = 0;
  std::uint16_t channels_ = 0;
  std::string schema_records_;
  std::string channel_records_;
  std::string chunk_indices_;
  std::string metadata_indices_;
  std::string attachment_indices_;
  std::uint32_t chunk_count_ = 0;
  std::uint32_t metadata_count_ = 0;
  std::uint32_t attachment_count_ = 0;
  std::uint64_t message_count_ = 0;
  std::map<std::uint16_t, std::uint64_t> counts_;  ///< of messages, by channel
  Span span_;

  Chunk filling_;
  Chunk packing_;  ///< what the packer is at; without messages where it rests
  ChunkPacker packer_;
};

}  // namespace sprung::log
