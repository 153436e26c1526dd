#pragma once
/// Records of the MCAP format (mcap.dev/spec, version 0), as bytes. Pure. Everything is little endian.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace sprung::log {

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

}  // namespace sprung::log
