#include "drivers/canopen/sdo_server.h"

namespace sprung::canopen {

bool SdoServer::receive(const CanFrame& request, std::int64_t time_us, CanFrame& reply) noexcept {
  if (request.id != sdo_client_id(node_)) return false;
  const SdoMessage message = decode_sdo_request(request);
  if (message.kind == SdoKind::kInvalid) return false;
  heard_us_ = time_us;
  if (message.kind == SdoKind::kAbort) {
    reset();
    return false;
  }
  reply = serve(message, request);
  return true;
}

bool SdoServer::step(std::int64_t time_us, CanFrame& abort) noexcept {
  if (!busy() || time_us - heard_us_ < timeout_us_) return false;
  abort = give_up(object_, kAbortTimeout);
  return true;
}

CanFrame SdoServer::serve(const SdoMessage& request, const CanFrame& frame) noexcept {
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
    default:
      return give_up(request.object, kAbortCommand);
  }
}

CanFrame SdoServer::read(ObjectId object) noexcept {
  std::size_t size = 0;
  const std::uint32_t error = objects_.read(object, buffer_.data(), kMaxTransfer, size);
  if (error != 0) return give_up(object, error);
  if (size > kMaxTransfer) return give_up(object, kAbortMemory);
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
