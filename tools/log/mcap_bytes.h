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

/// The content of one record, put together field by field.
class McapFields {
 public:
  template <class Unsigned>
  McapFields& number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xFF);
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
  void clear() noexcept { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// Appends the record: operation, length (8 bytes), content.
inline void append_record(McapOp op, std::string_view content, std::string& out) {
  McapFields head;
  out +=
      head.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size())).bytes();
  out += content;
}

}  // namespace sprung::log
