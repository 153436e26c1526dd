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
#include "tools/logs/log/mcap_bytes.h"

namespace sprung::log {

struct McapOptions {
  std::size_t chunk_bytes = std::size_t{2}
                            << 20;  ///< a chunk is closed when its messages are as large as this
  bool compress = true;             ///< chunks with zstd
  int zstd_level = 1;               ///< negative: faster, and larger
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
