#include "drivers/canopen/sdo_client.h"

#include <algorithm>

namespace sprung::canopen {
namespace {

constexpr int kMaxAttempts = 2;

}  // namespace

void SdoClient::begin(ObjectId object, SdoKind kind) noexcept {
  object_ = object;
  kind_ = kind;
  status_ = SdoStatus::kBusy;
  value_ = 0;
  abort_due_ = 0;
  attempts_ = 0;
  restart();
}

void SdoClient::restart() noexcept {
  phase_ = Phase::kBegin;
  ++attempts_;
  waiting_ = false;
  toggle_ = false;
  buffer_.rewind();
  segmented_ = kind_ == SdoKind::kDownload && (buffer_.size() == 0 || buffer_.size() > kExpeditedBytes);
}

void SdoClient::read(ObjectId object) noexcept {
  buffer_.filled(0);
  begin(object, SdoKind::kUpload);
}

void SdoClient::write(ObjectId object, std::uint32_t value, int size) noexcept {
  put_le(buffer_.data(), value, size);
  buffer_.filled(static_cast<std::size_t>(size));
  begin(object, SdoKind::kDownload);
}

void SdoClient::write(ObjectId object, const std::uint8_t* bytes, std::size_t count) noexcept {
  const bool fits = buffer_.assign(bytes, count);
  begin(object, SdoKind::kDownload);
  if (fits) return;
  value_ = kAbortMemory;
  status_ = SdoStatus::kAborted;
}

bool SdoClient::step(std::int64_t time_us, CanFrame& request) noexcept {
  if (status_ != SdoStatus::kBusy) return false;
  if (abort_due_ != 0) {
    request = sdo_client_abort(node_, object_, abort_due_);
    value_ = abort_due_;
    status_ = SdoStatus::kAborted;
    return true;
  }
  if (waiting_) return time_us - sent_us_ >= timeout_us_ && time_out(time_us, request);
  request = next_request();
  waiting_ = true;
  sent_us_ = time_us;
  return true;
}

bool SdoClient::time_out(std::int64_t time_us, CanFrame& request) noexcept {
  const bool tell_server = segmented_;
  if (attempts_ == kMaxAttempts) {
    status_ = SdoStatus::kTimeout;
  } else {
    restart();
  }
  if (!tell_server) return step(time_us, request);
  request = sdo_client_abort(node_, object_, kAbortTimeout);
  return true;
}

CanFrame SdoClient::next_request() noexcept {
  return phase_ == Phase::kBegin ? first_request() : next_segment();
}

CanFrame SdoClient::first_request() const noexcept {
  if (kind_ == SdoKind::kUpload) return sdo_read_request(node_, object_);
  if (segmented_) return sdo_write_begin(node_, object_, buffer_.size());
  const int size = static_cast<int>(buffer_.size());
  return sdo_write_request(node_, object_, get_le(buffer_.data(), size), size);
}

CanFrame SdoClient::next_segment() noexcept {
  if (kind_ == SdoKind::kUpload) return sdo_read_segment_request(node_, toggle_);
  const SdoBuffer::Chunk chunk = buffer_.next();
  last_ = chunk.last;
  return sdo_write_segment(node_, toggle_, chunk.bytes, chunk.count, chunk.last);
}

void SdoClient::receive(const CanFrame& frame) noexcept {
  if (status_ != SdoStatus::kBusy || !waiting_ || frame.id != sdo_server_id(node_)) return;
  const SdoMessage reply = decode_sdo_reply(frame);
  if (reply.kind == SdoKind::kAbort) {
    if (!(reply.object == object_)) return;
    value_ = reply.value;
    status_ = SdoStatus::kAborted;
  } else if (phase_ == Phase::kBegin) {
    receive_first(reply, frame);
  } else {
    receive_segment(reply, frame);
  }
}

void SdoClient::receive_first(const SdoMessage& reply, const CanFrame& frame) noexcept {
  if (!(reply.object == object_)) return;
  if (kind_ == SdoKind::kUpload && reply.kind == SdoKind::kUpload) {
    buffer_.assign(&frame.data[4], static_cast<std::size_t>(reply.size == 0 ? kExpeditedBytes : reply.size));
    done();
  } else if (kind_ == SdoKind::kUpload && reply.kind == SdoKind::kUploadBegin) {
    segmented_ = true;
    phase_ = Phase::kSegments;
    go_on();
    if (const std::uint32_t error = buffer_.expect(reply.size != 0, reply.value)) fail(error);
  } else if (kind_ == SdoKind::kDownload && reply.kind == SdoKind::kDownload) {
    if (!segmented_) return done();
    phase_ = Phase::kSegments;
    go_on();
  }
}

void SdoClient::receive_segment(const SdoMessage& reply, const CanFrame& frame) noexcept {
  const bool upload = kind_ == SdoKind::kUpload;
  if (reply.kind != (upload ? SdoKind::kUploadSegment : SdoKind::kDownloadSegment)) return;
  if (reply.toggle != toggle_) return fail(kAbortToggle);
  if (upload) {
    if (const std::uint32_t error = buffer_.append(&frame.data[1], reply.size, reply.last))
      return fail(error);
    last_ = reply.last;
  }
  toggle_ = !toggle_;
  if (last_) return done();
  go_on();
}

void SdoClient::done() noexcept {
  const auto size = static_cast<int>(std::min<std::size_t>(buffer_.size(), kExpeditedBytes));
  value_ = get_le(buffer_.data(), size);
  status_ = SdoStatus::kDone;
}

void SdoClient::fail(std::uint32_t abort_code) noexcept {
  abort_due_ = abort_code;
  waiting_ = false;
}

}  // namespace sprung::canopen
