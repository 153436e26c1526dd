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
  blocks_ = blocks_ && attempts_ == 1;
  block_ack_ = -1;
  heard_ = false;
}

/// A server that does not know a command may not know which object it was about either.
void SdoClient::ask_plainly() noexcept {
  blocks_ = false;
  attempts_ = 0;
  restart();
}

void SdoClient::read(ObjectId object, SdoService service) noexcept {
  buffer_.filled(0);
  blocks_ = service == SdoService::kBlock;
  begin(object, SdoKind::kUpload);
}

void SdoClient::write(ObjectId object, std::uint32_t value, int size) noexcept {
  put_le(buffer_.data(), value, size);
  blocks_ = false;
  buffer_.filled(static_cast<std::size_t>(size));
  begin(object, SdoKind::kDownload);
}

void SdoClient::write(ObjectId object, const std::uint8_t* bytes, std::size_t count,
                      SdoService service) noexcept {
  const bool fits = buffer_.assign(bytes, count);
  blocks_ = service == SdoService::kBlock && count > kBlockWorthwhile;
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
  if (heard_) sent_us_ = time_us;
  heard_ = false;
  if (waiting_) return time_us - sent_us_ >= timeout_us_ && time_out(time_us, request);
  sent_us_ = time_us;
  return next_frame(request);
}

bool SdoClient::next_frame(CanFrame& request) noexcept {
  if (phase_ == Phase::kBlocks || phase_ == Phase::kBlockEnd) return next_of_blocks(request);
  request = next_request();
  waiting_ = true;
  return true;
}

/// Only a block's segments go out in a row; whoever reads has nothing to send but acknowledgements.
bool SdoClient::next_of_blocks(CanFrame& request) noexcept {
  const bool upload = kind_ == SdoKind::kUpload;
  waiting_ = true;
  if (phase_ == Phase::kBlockEnd) {
    if (upload) done();
    request = upload ? sdo_block_read_taken(node_)
                     : sdo_block_write_end(
                           node_, sender_.unused(),
                           block_crc_ ? block_crc(buffer_.data(), buffer_.size()) : std::uint16_t{0});
    return true;
  }
  if (upload) {
    request = block_ack_ < 0 ? sdo_block_read_start(node_) : sdo_block_read_ack(node_, block_ack_);
    return true;
  }
  waiting_ = !sender_.next(sdo_client_id(node_), buffer_.data(), request);
  return !waiting_;
}

/// A block that breaks off is acknowledged as far as it came: the rest comes again.
bool SdoClient::time_out(std::int64_t time_us, CanFrame& request) noexcept {
  if (phase_ == Phase::kBlocks && kind_ == SdoKind::kUpload && receiver_.begun()) {
    block_ack_ = receiver_.acknowledge();
    go_on();
    return step(time_us, request);
  }
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
  if (blocks_ && kind_ == SdoKind::kUpload)
    return sdo_block_read_request(node_, object_, static_cast<int>(kBlockWorthwhile));
  if (blocks_) return sdo_block_write_begin(node_, object_, buffer_.size());
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
  const bool in_blocks = phase_ == Phase::kBlocks;  // where a server may complain before a block is over
  if (status_ != SdoStatus::kBusy || (!waiting_ && !in_blocks) || frame.id != sdo_server_id(node_)) return;
  const SdoMessage reply = decode_sdo_reply(frame);
  if (reply.kind == SdoKind::kAbort) {
    if (blocks_ && phase_ == Phase::kBegin && reply.value == kAbortCommand) return ask_plainly();
    if (!(reply.object == object_)) return;
    value_ = reply.value;
    status_ = SdoStatus::kAborted;
  } else if (in_blocks || phase_ == Phase::kBlockEnd) {
    receive_blocks(frame);
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
  } else if (blocks_ &&
             (reply.kind == SdoKind::kBlockUploadBegin || reply.kind == SdoKind::kBlockDownloadBegin)) {
    begin_blocks(reply);
  } else if (kind_ == SdoKind::kDownload && reply.kind == SdoKind::kDownload && !blocks_) {
    if (!segmented_) return done();
    phase_ = Phase::kSegments;
    go_on();
  }
}

void SdoClient::begin_blocks(const SdoMessage& reply) noexcept {
  const bool upload = reply.kind == SdoKind::kBlockUploadBegin;
  if (upload != (kind_ == SdoKind::kUpload)) return;
  segmented_ = true;
  phase_ = Phase::kBlocks;
  block_crc_ = reply.block.with_crc;
  go_on();
  receiver_.begin();
  const std::uint32_t error = upload ? buffer_.expect(reply.size != 0, reply.value)
                                     : sender_.begin(buffer_.size(), reply.block.size);
  if (error != 0) fail(error);
}

void SdoClient::receive_blocks(const CanFrame& frame) noexcept {
  const SdoMessage reply = decode_sdo_reply(frame);
  const bool upload = kind_ == SdoKind::kUpload;
  if (phase_ == Phase::kBlockEnd) {
    if (!upload && reply.kind == SdoKind::kBlockDownloadEnd) done();
  } else if (!upload) {
    if (reply.kind != SdoKind::kBlockDownloadAck) return;
    go_on();
    if (const std::uint32_t error = sender_.acknowledge(reply.block)) return fail(error);
    if (sender_.done()) phase_ = Phase::kBlockEnd;
  } else if (receiver_.complete() && !receiver_.begun()) {
    if (reply.kind == SdoKind::kBlockUploadEnd) receive_block_end(reply);
  } else {
    receive_block_segment(frame);
  }
}

void SdoClient::receive_block_segment(const CanFrame& frame) noexcept {
  bool due = false;
  if (const std::uint32_t error = receiver_.take(frame, buffer_, due)) return fail(error);
  heard_ = true;
  if (!due) return;
  block_ack_ = receiver_.acknowledge();
  go_on();
}

void SdoClient::receive_block_end(const SdoMessage& reply) noexcept {
  if (const std::uint32_t error = receiver_.finish(reply.block, block_crc_, buffer_)) return fail(error);
  phase_ = Phase::kBlockEnd;
  go_on();
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
