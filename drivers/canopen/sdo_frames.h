#pragma once
/// SDO frames (CiA 301 7.2.4.3, facts canopen 1.4): expedited and segmented, of client and server, byte for
/// byte. Block transfer is not supported: a server answers it with kAbortCommand, as CiA 301 lets it. Pure
/// values.
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_aborts.h"
#include "drivers/canopen/wire.h"

namespace sprung::canopen {

inline constexpr int kSegmentBytes = 7;    ///< of data in one segment
inline constexpr int kExpeditedBytes = 4;  ///< of data in the first frame

enum class SdoKind : std::uint8_t {
  kInvalid,          ///< no SDO frame: not 8 bytes of data
  kUpload,           ///< request: read; reply: the value, expedited
  kDownload,         ///< request: expedited write; reply: acknowledged, or begun
  kAbort,            ///< value holds the abort code
  kUploadBegin,      ///< reply only: segments follow when asked for
  kDownloadBegin,    ///< request only: segments follow
  kUploadSegment,    ///< request: the next one; reply: its data
  kDownloadSegment,  ///< request: its data; reply: acknowledged
  kUnsupported,      ///< block transfer, or a command that this direction does not have
};

/// Request or reply.
struct SdoMessage {
  SdoKind kind = SdoKind::kInvalid;
  ObjectId object;          ///< 0:0 in segments, which do not carry it
  std::uint32_t value = 0;  ///< expedited value, abort code, or bytes announced at the beginning of segments
  int size = 0;             ///< bytes of value; of data in a segment, from byte 1; 0 where none, or not told
  bool toggle = false;      ///< segments: alternates, beginning with false
  bool last = false;        ///< segments with data: none follows
};

// Client: request frames to `node`, and what its reply means. `size` and `count` are bytes of value or data.
CanFrame sdo_read_request(int node, ObjectId object) noexcept;
CanFrame sdo_write_request(int node, ObjectId object, std::uint32_t value, int size) noexcept;
CanFrame sdo_read_segment_request(int node, bool toggle) noexcept;
CanFrame sdo_write_begin(int node, ObjectId object, std::size_t size) noexcept;
CanFrame sdo_write_segment(int node, bool toggle, const std::uint8_t* bytes, int count, bool last) noexcept;
CanFrame sdo_client_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept;
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

}  // namespace sprung::canopen
