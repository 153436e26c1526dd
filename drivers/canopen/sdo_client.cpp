#include "drivers/canopen/sdo_client.h"

namespace sprung::canopen {
namespace {

constexpr int kMaxAttempts = 2;

}  // namespace

void SdoClient::begin(const CanFrame& request, ObjectId object, SdoKind kind) noexcept {
  request_ = request;
  object_ = object;
  kind_ = kind;
  status_ = SdoStatus::kBusy;
  value_ = 0;
  attempts_ = 0;
}

void SdoClient::read(ObjectId object) noexcept {
  begin(sdo_read_request(node_, object), object, SdoKind::kUpload);
}

void SdoClient::write(ObjectId object, std::uint32_t value, int size) noexcept {
  begin(sdo_write_request(node_, object, value, size), object, SdoKind::kDownload);
}

bool SdoClient::step(std::int64_t time_us, CanFrame& request) noexcept {
  if (status_ != SdoStatus::kBusy) return false;
  if (attempts_ > 0 && time_us - sent_us_ < timeout_us_) return false;
  if (attempts_ == kMaxAttempts) {
    status_ = SdoStatus::kTimeout;
    return false;
  }
  ++attempts_;
  sent_us_ = time_us;
  request = request_;
  return true;
}

void SdoClient::receive(const CanFrame& frame) noexcept {
  if (status_ != SdoStatus::kBusy || attempts_ == 0) return;
  const SdoMessage reply = decode_sdo_reply(frame);
  if (!(reply.object == object_)) return;
  if (reply.kind == SdoKind::kAbort) {
    value_ = reply.value;
    status_ = SdoStatus::kAborted;
  } else if (reply.kind == kind_) {
    value_ = reply.value;
    status_ = SdoStatus::kDone;
  }
}

}  // namespace sprung::canopen
