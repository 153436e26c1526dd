#include "drivers/canopen/sdo_server.h"

namespace sprung::canopen {
namespace {

/// Offers a checksum to a client that checks one, and to no other: some take the server's word alone.
CanFrame checked(CanFrame begin, bool with_crc) noexcept {
  constexpr std::uint8_t kCrcBit = 0x04;
  if (!with_crc) begin.data[0] = static_cast<std::uint8_t>(begin.data[0] & ~kCrcBit);
  return begin;
}

}  // namespace

bool SdoServer::receive(const CanFrame& request, std::int64_t time_us, CanFrame& reply) noexcept {
  if (request.id != sdo_client_id(node_)) return false;
  const SdoMessage message = decode_sdo_request(request);
  if (message.kind == SdoKind::kInvalid) return false;
  if (message.kind == SdoKind::kAbort) {
    reset();
    return false;
  }
  if (in_block()) return take_segment(request, time_us, reply);
  heard_us_ = time_us;
  return serve(message, request, reply);
}

bool SdoServer::in_block() const noexcept {
  return transfer_ == Transfer::kBlockDownload && (!receiver_.complete() || receiver_.begun());
}

bool SdoServer::step(std::int64_t time_us, CanFrame& frame) noexcept {
  if (!busy()) return false;
  if (transfer_ == Transfer::kBlockUpload && sender_.next(sdo_server_id(node_), buffer_.data(), frame)) {
    heard_us_ = time_us;
    return true;
  }
  const std::int64_t silent_us = time_us - heard_us_;
  // Before the client gives up: it may wait for the acknowledgement of a block whose last segment was lost.
  if (transfer_ == Transfer::kBlockDownload && receiver_.begun() && silent_us >= timeout_us_ / 4) {
    frame = sdo_block_write_ack(node_, receiver_.acknowledge());
    return true;
  }
  if (silent_us < timeout_us_) return false;
  frame = give_up(object_, kAbortTimeout);
  return true;
}

bool SdoServer::serve(const SdoMessage& request, const CanFrame& frame, CanFrame& reply) noexcept {
  switch (request.kind) {
    case SdoKind::kBlockUploadStart:
    case SdoKind::kBlockUploadAck:
    case SdoKind::kBlockUploadEnd:
    case SdoKind::kBlockDownloadEnd:
      return serve_block(request, reply);
    default:
      reply = answer_plain(request, frame);
      return true;
  }
}

CanFrame SdoServer::answer_plain(const SdoMessage& request, const CanFrame& frame) noexcept {
  switch (request.kind) {
    case SdoKind::kUpload:
      return read(request.object);
    case SdoKind::kDownload:
      return write(request, frame);
    case SdoKind::kDownloadBegin:
      return begin_write(request);
    case SdoKind::kUploadSegment:
      return read_segment(request);
    case SdoKind::kDownloadSegment:
      return write_segment(request, frame);
    case SdoKind::kBlockUploadBegin:
      return begin_block_read(request);
    case SdoKind::kBlockDownloadBegin:
      return begin_block_write(request);
    default:
      return give_up(request.object, kAbortCommand);
  }
}

CanFrame SdoServer::read(ObjectId object) noexcept {
  std::size_t size = 0;
  const std::uint32_t error = objects_.read(object, buffer_.data(), kMaxTransfer, size);
  if (error != 0) return give_up(object, error);
  if (size > kMaxTransfer) return give_up(object, kAbortMemory);
  return answer_read(object, size);
}

CanFrame SdoServer::answer_read(ObjectId object, std::size_t size) noexcept {
  if (size >= 1 && size <= kExpeditedBytes) {
    reset();
    const int count = static_cast<int>(size);
    return sdo_read_reply(node_, object, get_le(buffer_.data(), count), count);
  }
  transfer_ = Transfer::kUpload;
  object_ = object;
  toggle_ = false;
  buffer_.filled(size);
  return sdo_read_begin_reply(node_, object, size);
}

CanFrame SdoServer::begin_block_read(const SdoMessage& request) noexcept {
  std::size_t size = 0;
  std::uint32_t error = objects_.read(request.object, buffer_.data(), kMaxTransfer, size);
  if (error == 0 && size > kMaxTransfer) error = kAbortMemory;
  if (error == 0) error = sender_.begin(size, request.block.size);
  if (error != 0) return give_up(request.object, error);
  const auto threshold = static_cast<std::size_t>(request.block.threshold);
  if (threshold != 0 && size <= threshold) return answer_read(request.object, size);
  transfer_ = Transfer::kBlockUploadBegun;
  object_ = request.object;
  block_crc_ = request.block.with_crc;
  buffer_.filled(size);
  return checked(sdo_block_read_begin(node_, object_, size), block_crc_);
}

CanFrame SdoServer::begin_block_write(const SdoMessage& request) noexcept {
  const std::uint32_t error = buffer_.expect(request.size != 0, request.value);
  if (error != 0) return give_up(request.object, error);
  transfer_ = Transfer::kBlockDownload;
  object_ = request.object;
  block_crc_ = request.block.with_crc;
  receiver_.begin();
  return checked(sdo_block_write_reply(node_, object_), block_crc_);
}

bool SdoServer::serve_block(const SdoMessage& request, CanFrame& reply) noexcept {
  if (transfer_ == Transfer::kBlockUploadBegun && request.kind == SdoKind::kBlockUploadStart) {
    transfer_ = Transfer::kBlockUpload;
    return false;
  }
  if (transfer_ == Transfer::kBlockUpload && request.kind == SdoKind::kBlockUploadAck)
    return go_on_block_read(request, reply);
  if (transfer_ == Transfer::kBlockUploadEnd && request.kind == SdoKind::kBlockUploadEnd) {
    reset();
    return false;
  }
  const bool ends = transfer_ == Transfer::kBlockDownload && request.kind == SdoKind::kBlockDownloadEnd;
  reply = ends ? end_block_write(request) : give_up(object_, kAbortCommand);
  return true;
}

/// @return whether all was acknowledged, and `reply` is the end; else step() has the next segments.
bool SdoServer::go_on_block_read(const SdoMessage& request, CanFrame& reply) noexcept {
  if (const std::uint32_t error = sender_.acknowledge(request.block)) {
    reply = give_up(object_, error);
    return true;
  }
  if (!sender_.done()) return false;
  transfer_ = Transfer::kBlockUploadEnd;
  const std::uint16_t crc = block_crc_ ? block_crc(buffer_.data(), buffer_.size()) : std::uint16_t{0};
  reply = sdo_block_read_end(node_, sender_.unused(), crc);
  return true;
}

/// Only what brings the value on counts as heard: a client that has begun something else is not understood
/// until this transfer has timed out.
bool SdoServer::take_segment(const CanFrame& frame, std::int64_t time_us, CanFrame& reply) noexcept {
  bool due = false;
  const int before = receiver_.in_order();
  const std::uint32_t error = receiver_.take(frame, buffer_, due);
  if (receiver_.in_order() != before) heard_us_ = time_us;
  if (error != 0) {
    reply = give_up(object_, error);
    return true;
  }
  if (due) reply = sdo_block_write_ack(node_, receiver_.acknowledge());
  return due;
}

CanFrame SdoServer::end_block_write(const SdoMessage& request) noexcept {
  std::uint32_t error = receiver_.finish(request.block, block_crc_, buffer_);
  if (error == 0) error = objects_.write(object_, buffer_.data(), buffer_.size(), true);
  if (error != 0) return give_up(object_, error);
  reset();
  return sdo_block_write_taken(node_);
}

CanFrame SdoServer::write(const SdoMessage& request, const CanFrame& frame) noexcept {
  reset();
  const bool told = request.size != 0;
  const auto size = static_cast<std::size_t>(told ? request.size : kExpeditedBytes);
  const std::uint32_t error = objects_.write(request.object, &frame.data[4], size, told);
  if (error != 0) return give_up(request.object, error);
  return sdo_write_reply(node_, request.object);
}

CanFrame SdoServer::begin_write(const SdoMessage& request) noexcept {
  const std::uint32_t error = buffer_.expect(request.size != 0, request.value);
  if (error != 0) return give_up(request.object, error);
  transfer_ = Transfer::kDownload;
  object_ = request.object;
  toggle_ = false;
  return sdo_write_reply(node_, request.object);
}

CanFrame SdoServer::read_segment(const SdoMessage& request) noexcept {
  if (transfer_ != Transfer::kUpload) return give_up(object_, kAbortCommand);
  if (request.toggle != toggle_) return give_up(object_, kAbortToggle);
  const SdoBuffer::Chunk chunk = buffer_.next();
  toggle_ = !toggle_;
  if (chunk.last) reset();
  return sdo_read_segment_reply(node_, request.toggle, chunk.bytes, chunk.count, chunk.last);
}

CanFrame SdoServer::write_segment(const SdoMessage& request, const CanFrame& frame) noexcept {
  if (transfer_ != Transfer::kDownload) return give_up(object_, kAbortCommand);
  if (request.toggle != toggle_) return give_up(object_, kAbortToggle);
  std::uint32_t error = buffer_.append(&frame.data[1], request.size, request.last);
  if (error == 0 && request.last) error = objects_.write(object_, buffer_.data(), buffer_.size(), true);
  if (error != 0) return give_up(object_, error);
  toggle_ = !toggle_;
  if (request.last) reset();
  return sdo_write_segment_reply(node_, request.toggle);
}

CanFrame SdoServer::give_up(ObjectId object, std::uint32_t abort_code) noexcept {
  reset();
  return sdo_server_abort(node_, object, abort_code);
}

}  // namespace sprung::canopen
