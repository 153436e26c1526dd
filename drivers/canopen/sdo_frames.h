#pragma once
/// SDO frames (CiA 301 7.2.4.3, facts canopen 1.4): expedited, segmented and block transfer, of client and
/// server, byte for byte. Pure values.
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_aborts.h"
#include "drivers/canopen/wire.h"

namespace sprung::canopen {

inline constexpr int kSegmentBytes = 7;    ///< of data in one segment
inline constexpr int kExpeditedBytes = 4;  ///< of data in the first frame
inline constexpr int kMaxBlock = 127;      ///< segments in a block

enum class SdoKind : std::uint8_t {
  kInvalid,             ///< no SDO frame: not 8 bytes of data
  kUpload,              ///< request: read; reply: the value, expedited
  kDownload,            ///< request: expedited write; reply: acknowledged, or begun
  kAbort,               ///< value holds the abort code
  kUploadBegin,         ///< reply only: segments follow when asked for
  kDownloadBegin,       ///< request only: segments follow
  kUploadSegment,       ///< request: the next one; reply: its data
  kDownloadSegment,     ///< request: its data; reply: acknowledged
  kBlockDownloadBegin,  ///< request: value bytes are to come; reply: a block may begin
  kBlockDownloadAck,    ///< reply only: the segments of a block that arrived in order
  kBlockDownloadEnd,    ///< request: all was sent; reply: it was taken
  kBlockUploadBegin,    ///< request: read; reply: value bytes will come
  kBlockUploadStart,    ///< request only: the first block may begin
  kBlockUploadAck,      ///< request only: the segments of a block that arrived in order
  kBlockUploadEnd,      ///< reply: all was sent; request: it was taken
  kUnsupported,         ///< a command that this direction does not have
};

/// What frames of a block transfer carry beside; the segments of a block are told by what came before them
/// alone (sdo_block.h).
struct SdoBlockFields {
  int size = 0;           ///< begin, acknowledgement: segments in the next block, as it came: any byte
  int acknowledged = 0;   ///< acknowledgement: the last segment that came in order, 0 = none; any byte
  int threshold = 0;      ///< request to read: up to so many bytes the server may answer plainly; 0 = never
  int unused = 0;         ///< end: bytes of the last segment that are no data, 0..7
  bool with_crc = false;  ///< begin: the sender of this frame can check one
  std::uint16_t crc = 0;  ///< end
};

/// Request or reply.
struct SdoMessage {
  SdoKind kind = SdoKind::kInvalid;
  ObjectId object;          ///< 0:0 in segments, which do not carry it
  std::uint32_t value = 0;  ///< expedited value, abort code, or bytes announced at the beginning of segments
  int size = 0;             ///< bytes of value; of data in a segment, from byte 1; 0 where none, or not told
  bool toggle = false;      ///< segments: alternates, beginning with false
  bool last = false;        ///< segments with data: none follows
  SdoBlockFields block;
};

// Client: request frames to `node`, and what its reply means. `size` and `count` are bytes of value or data.
CanFrame sdo_read_request(int node, ObjectId object) noexcept;
CanFrame sdo_write_request(int node, ObjectId object, std::uint32_t value, int size) noexcept;
CanFrame sdo_read_segment_request(int node, bool toggle) noexcept;
CanFrame sdo_write_begin(int node, ObjectId object, std::size_t size) noexcept;
CanFrame sdo_write_segment(int node, bool toggle, const std::uint8_t* bytes, int count, bool last) noexcept;
CanFrame sdo_client_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept;
CanFrame sdo_block_read_request(int node, ObjectId object, int threshold) noexcept;  ///< with CRC
CanFrame sdo_block_read_start(int node) noexcept;
CanFrame sdo_block_read_ack(int node, int acknowledged) noexcept;
CanFrame sdo_block_read_taken(int node) noexcept;
CanFrame sdo_block_write_begin(int node, ObjectId object, std::size_t size) noexcept;  ///< with CRC
CanFrame sdo_block_write_end(int node, int unused, std::uint16_t crc) noexcept;
SdoMessage decode_sdo_reply(const CanFrame& frame) noexcept;

// Server: what a request means, and reply frames of `node`.
SdoMessage decode_sdo_request(const CanFrame& frame) noexcept;
CanFrame sdo_read_reply(int node, ObjectId object, std::uint32_t value, int size) noexcept;
CanFrame sdo_read_begin_reply(int node, ObjectId object, std::size_t size) noexcept;
CanFrame sdo_read_segment_reply(int node, bool toggle, const std::uint8_t* bytes, int count,
                                bool last) noexcept;
/// Acknowledges an expedited write, and the beginning of a segmented one.
CanFrame sdo_write_reply(int node, ObjectId object) noexcept;
CanFrame sdo_write_segment_reply(int node, bool toggle) noexcept;
CanFrame sdo_server_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept;
CanFrame sdo_block_read_begin(int node, ObjectId object, std::size_t size) noexcept;  ///< with CRC
CanFrame sdo_block_read_end(int node, int unused, std::uint16_t crc) noexcept;
CanFrame sdo_block_write_reply(int node, ObjectId object) noexcept;  ///< with CRC
CanFrame sdo_block_write_ack(int node, int acknowledged) noexcept;
CanFrame sdo_block_write_taken(int node) noexcept;

/// One segment of a block, of client or server. @param id sdo_client_id() or sdo_server_id(). @param sequence
/// 1..127. @param count of bytes: 7 but in the last one.
CanFrame sdo_block_segment(std::uint32_t id, int sequence, const std::uint8_t* bytes, int count,
                           bool last) noexcept;

}  // namespace sprung::canopen
