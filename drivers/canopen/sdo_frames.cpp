#include "drivers/canopen/sdo_frames.h"

#include <algorithm>

namespace sprung::canopen {
namespace {

// Commands; the upper three bits are the specifier. Expedited ones with the expedited and size-told bits set:
// n unused bytes go to bits 2-3.
constexpr std::uint8_t kWriteExpedited = 0x23;
constexpr std::uint8_t kWriteNoSize = 0x22;
constexpr std::uint8_t kWriteBegin = 0x21;
constexpr std::uint8_t kWriteBeginNoSize = 0x20;
constexpr std::uint8_t kReadRequest = 0x40;
constexpr std::uint8_t kReadSegment = 0x60;
constexpr std::uint8_t kReadReplyExpedited = 0x43;
constexpr std::uint8_t kReadReplyNoSize = 0x42;
constexpr std::uint8_t kReadReplyBegin = 0x41;
constexpr std::uint8_t kReadReplyBeginNoSize = 0x40;
constexpr std::uint8_t kWriteReply = 0x60;
constexpr std::uint8_t kWriteSegmentReply = 0x20;
constexpr std::uint8_t kAbort = 0x80;

// Block transfer: begin (with CRC 0x04; size told 0x02), start, acknowledgement, end (unused bytes in bits
// 2-4). Uploads of a server begin as downloads of a client do, and the other way round.
constexpr std::uint8_t kBlockData = 0xC0;     // from who has the data: begin
constexpr std::uint8_t kBlockDataEnd = 0xC1;  // end
constexpr std::uint8_t kBlockTake = 0xA0;     // from who wants them: begin
constexpr std::uint8_t kBlockTaken = 0xA1;    // end
constexpr std::uint8_t kBlockAck = 0xA2;
constexpr std::uint8_t kBlockStart = 0xA3;
constexpr std::uint8_t kBlockCrc = 0x04;
constexpr std::uint8_t kBlockSizeTold = 0x02;
constexpr std::uint8_t kBlockEndMask = 0xE3;

constexpr std::uint8_t kSpecifierMask = 0xE0;
constexpr std::uint8_t kUnusedMask = 0x0C;
constexpr std::uint8_t kSegmentToggle = 0x10;
constexpr std::uint8_t kLast = 0x01;

std::uint8_t with_size(std::uint8_t command, int size) noexcept {
  return static_cast<std::uint8_t>(command | ((kExpeditedBytes - size) << 2));
}

std::uint8_t with_toggle(std::uint8_t command, bool toggle) noexcept {
  return toggle ? static_cast<std::uint8_t>(command | kSegmentToggle) : command;
}

CanFrame sdo_frame(std::uint32_t id, std::uint8_t command, ObjectId object, std::uint32_t value,
                   int size) noexcept {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data[0] = command;
  put_le(&frame.data[1], object.index, 2);
  frame.data[3] = object.sub;
  put_le(&frame.data[4], value, size);
  return frame;
}

CanFrame segment_frame(std::uint32_t id, bool toggle, const std::uint8_t* bytes, int count,
                       bool last) noexcept {
  const int unused = kSegmentBytes - count;
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data[0] = with_toggle(static_cast<std::uint8_t>((unused << 1) | (last ? kLast : 0)), toggle);
  std::copy(bytes, bytes + count, frame.data.begin() + 1);
  return frame;
}

SdoMessage message(SdoKind kind, const CanFrame& frame, int size) noexcept {
  SdoMessage result;
  result.kind = kind;
  result.object = {static_cast<std::uint16_t>(get_le(&frame.data[1], 2)), frame.data[3]};
  result.size = size;
  result.value = get_le(&frame.data[4], size == 0 ? kExpeditedBytes : size);
  return result;
}

/// The two services that carry a value in their first frame, with and without its size.
SdoMessage decode_value(SdoKind kind, const CanFrame& frame, std::uint8_t sized,
                        std::uint8_t unsized) noexcept {
  const std::uint8_t command = frame.data[0];
  if ((command & ~kUnusedMask) == sized) {
    return message(kind, frame, kExpeditedBytes - ((command & kUnusedMask) >> 2));
  }
  return message(command == unsized ? kind : SdoKind::kUnsupported, frame, 0);
}

/// The first frame of a segmented transfer; `value` is the announced size, if there is one.
SdoMessage begin(SdoKind kind, const CanFrame& frame, bool sized) noexcept {
  SdoMessage result = message(kind, frame, sized ? kExpeditedBytes : 0);
  if (!sized) result.value = 0;
  return result;
}

SdoMessage segment(SdoKind kind, const CanFrame& frame) noexcept {
  const std::uint8_t command = frame.data[0];
  SdoMessage result;
  result.kind = kind;
  result.toggle = (command & kSegmentToggle) != 0;
  result.last = (command & kLast) != 0;
  result.size = kSegmentBytes - ((command >> 1) & 7);
  return result;
}

SdoMessage bare_segment(SdoKind kind, const CanFrame& frame) noexcept {
  SdoMessage result;
  result.kind = kind;
  result.toggle = (frame.data[0] & kSegmentToggle) != 0;
  return result;
}

/// Both directions: who has the data begins with their size and ends with their checksum, who takes them says
/// how many segments a block may have and which of them arrived.
/// @return kUnsupported for what is no frame of a block transfer.
SdoMessage decode_block(const CanFrame& frame, bool request) noexcept {
  const std::uint8_t command = frame.data[0];
  SdoMessage result = message(SdoKind::kUnsupported, frame, 0);
  if ((command & ~(kBlockCrc | kBlockSizeTold)) == kBlockData) {
    result = begin(request ? SdoKind::kBlockDownloadBegin : SdoKind::kBlockUploadBegin, frame,
                   (command & kBlockSizeTold) != 0);
    result.block.with_crc = (command & kBlockCrc) != 0;
  } else if ((command & kBlockEndMask) == kBlockDataEnd) {
    result.kind = request ? SdoKind::kBlockDownloadEnd : SdoKind::kBlockUploadEnd;
    result.block.unused = (command >> 2) & 7;
    result.block.crc = static_cast<std::uint16_t>(get_le(&frame.data[1], 2));
  } else if ((command & ~kBlockCrc) == kBlockTake) {
    result.kind = request ? SdoKind::kBlockUploadBegin : SdoKind::kBlockDownloadBegin;
    result.block.with_crc = (command & kBlockCrc) != 0;
    result.block.size = frame.data[4];
    result.block.threshold = request ? frame.data[5] : 0;
  } else if (command == kBlockTaken) {
    result.kind = request ? SdoKind::kBlockUploadEnd : SdoKind::kBlockDownloadEnd;
  } else if (command == kBlockAck) {
    result.kind = request ? SdoKind::kBlockUploadAck : SdoKind::kBlockDownloadAck;
    result.block.acknowledged = frame.data[1];
    result.block.size = frame.data[2];
  } else if (command == kBlockStart && request) {
    result.kind = SdoKind::kBlockUploadStart;
  }
  return result;
}

CanFrame block_begin(std::uint32_t id, ObjectId object, std::size_t size) noexcept {
  return sdo_frame(id, kBlockData | kBlockCrc | kBlockSizeTold, object, static_cast<std::uint32_t>(size), 4);
}

CanFrame block_end(std::uint32_t id, int unused, std::uint16_t crc) noexcept {
  CanFrame frame = sdo_frame(id, static_cast<std::uint8_t>(kBlockDataEnd | (unused << 2)), {}, 0, 0);
  put_le(&frame.data[1], crc, 2);
  return frame;
}

CanFrame block_ack(std::uint32_t id, int acknowledged) noexcept {
  CanFrame frame = sdo_frame(id, kBlockAck, {}, 0, 0);
  frame.data[1] = static_cast<std::uint8_t>(acknowledged);
  frame.data[2] = kMaxBlock;
  return frame;
}

bool is_sdo(const CanFrame& frame) noexcept { return frame.length == 8 && !frame.remote && !frame.error; }

}  // namespace

CanFrame sdo_read_request(int node, ObjectId object) noexcept {
  return sdo_frame(sdo_client_id(node), kReadRequest, object, 0, 0);
}

CanFrame sdo_write_request(int node, ObjectId object, std::uint32_t value, int size) noexcept {
  return sdo_frame(sdo_client_id(node), with_size(kWriteExpedited, size), object, value, size);
}

CanFrame sdo_read_segment_request(int node, bool toggle) noexcept {
  return sdo_frame(sdo_client_id(node), with_toggle(kReadSegment, toggle), {}, 0, 0);
}

CanFrame sdo_write_begin(int node, ObjectId object, std::size_t size) noexcept {
  return sdo_frame(sdo_client_id(node), kWriteBegin, object, static_cast<std::uint32_t>(size), 4);
}

CanFrame sdo_write_segment(int node, bool toggle, const std::uint8_t* bytes, int count, bool last) noexcept {
  return segment_frame(sdo_client_id(node), toggle, bytes, count, last);
}

CanFrame sdo_client_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept {
  return sdo_frame(sdo_client_id(node), kAbort, object, abort_code, 4);
}

SdoMessage decode_sdo_reply(const CanFrame& frame) noexcept {
  if (!is_sdo(frame)) return {};
  const std::uint8_t command = frame.data[0];
  const int untoggled = command & ~kSegmentToggle;
  if (command == kAbort) return message(SdoKind::kAbort, frame, 4);
  if (command == kWriteReply) return message(SdoKind::kDownload, frame, 0);
  if (command == kReadReplyBegin || command == kReadReplyBeginNoSize) {
    return begin(SdoKind::kUploadBegin, frame, command == kReadReplyBegin);
  }
  if ((command & kSpecifierMask) == 0) return segment(SdoKind::kUploadSegment, frame);
  if (untoggled == kWriteSegmentReply) return bare_segment(SdoKind::kDownloadSegment, frame);
  const SdoMessage block = decode_block(frame, false);
  if (block.kind != SdoKind::kUnsupported) return block;
  return decode_value(SdoKind::kUpload, frame, kReadReplyExpedited, kReadReplyNoSize);
}

SdoMessage decode_sdo_request(const CanFrame& frame) noexcept {
  if (!is_sdo(frame)) return {};
  const std::uint8_t command = frame.data[0];
  const int untoggled = command & ~kSegmentToggle;
  if (command == kAbort) return message(SdoKind::kAbort, frame, 4);
  if (command == kReadRequest) return message(SdoKind::kUpload, frame, 0);
  if (command == kWriteBegin || command == kWriteBeginNoSize) {
    return begin(SdoKind::kDownloadBegin, frame, command == kWriteBegin);
  }
  if ((command & kSpecifierMask) == 0) return segment(SdoKind::kDownloadSegment, frame);
  if (untoggled == kReadSegment) return bare_segment(SdoKind::kUploadSegment, frame);
  const SdoMessage block = decode_block(frame, true);
  if (block.kind != SdoKind::kUnsupported) return block;
  return decode_value(SdoKind::kDownload, frame, kWriteExpedited, kWriteNoSize);
}

CanFrame sdo_block_read_request(int node, ObjectId object, int threshold) noexcept {
  const auto sizes = static_cast<std::uint32_t>(kMaxBlock | (threshold << 8));
  return sdo_frame(sdo_client_id(node), kBlockTake | kBlockCrc, object, sizes, 4);
}

CanFrame sdo_block_read_start(int node) noexcept {
  return sdo_frame(sdo_client_id(node), kBlockStart, {}, 0, 0);
}

CanFrame sdo_block_read_ack(int node, int acknowledged) noexcept {
  return block_ack(sdo_client_id(node), acknowledged);
}

CanFrame sdo_block_read_taken(int node) noexcept {
  return sdo_frame(sdo_client_id(node), kBlockTaken, {}, 0, 0);
}

CanFrame sdo_block_write_begin(int node, ObjectId object, std::size_t size) noexcept {
  return block_begin(sdo_client_id(node), object, size);
}

CanFrame sdo_block_write_end(int node, int unused, std::uint16_t crc) noexcept {
  return block_end(sdo_client_id(node), unused, crc);
}

CanFrame sdo_block_read_begin(int node, ObjectId object, std::size_t size) noexcept {
  return block_begin(sdo_server_id(node), object, size);
}

CanFrame sdo_block_read_end(int node, int unused, std::uint16_t crc) noexcept {
  return block_end(sdo_server_id(node), unused, crc);
}

CanFrame sdo_block_write_reply(int node, ObjectId object) noexcept {
  return sdo_frame(sdo_server_id(node), kBlockTake | kBlockCrc, object, kMaxBlock, 4);
}

CanFrame sdo_block_write_ack(int node, int acknowledged) noexcept {
  return block_ack(sdo_server_id(node), acknowledged);
}

CanFrame sdo_block_write_taken(int node) noexcept {
  return sdo_frame(sdo_server_id(node), kBlockTaken, {}, 0, 0);
}

CanFrame sdo_block_segment(std::uint32_t id, int sequence, const std::uint8_t* bytes, int count,
                           bool last) noexcept {
  CanFrame frame = sdo_frame(id, static_cast<std::uint8_t>(sequence | (last ? 0x80 : 0)), {}, 0, 0);
  std::copy(bytes, bytes + count, frame.data.begin() + 1);
  return frame;
}

CanFrame sdo_read_reply(int node, ObjectId object, std::uint32_t value, int size) noexcept {
  return sdo_frame(sdo_server_id(node), with_size(kReadReplyExpedited, size), object, value, size);
}

CanFrame sdo_read_begin_reply(int node, ObjectId object, std::size_t size) noexcept {
  return sdo_frame(sdo_server_id(node), kReadReplyBegin, object, static_cast<std::uint32_t>(size), 4);
}

CanFrame sdo_read_segment_reply(int node, bool toggle, const std::uint8_t* bytes, int count,
                                bool last) noexcept {
  return segment_frame(sdo_server_id(node), toggle, bytes, count, last);
}

CanFrame sdo_write_reply(int node, ObjectId object) noexcept {
  return sdo_frame(sdo_server_id(node), kWriteReply, object, 0, 0);
}

CanFrame sdo_write_segment_reply(int node, bool toggle) noexcept {
  return sdo_frame(sdo_server_id(node), with_toggle(kWriteSegmentReply, toggle), {}, 0, 0);
}

CanFrame sdo_server_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept {
  return sdo_frame(sdo_server_id(node), kAbort, object, abort_code, 4);
}

}  // namespace sprung::canopen
