#include "tools/can/sdo_session.h"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "drivers/canopen/eds.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace internal {

namespace {
constexpr std::int64_t kNoDescriptor_us = 500;  // memory: has nothing to poll
}

std::int64_t end_after(double seconds) { return monotonic_us() + std::llround(1e6 * seconds); }

bool over(std::int64_t end_us) { return monotonic_us() >= end_us || stop_requested(); }

int wait_and_receive(CanBus& bus, std::int64_t end_us, CanFrame* frames, int max) {
  const int count = bus.receive(frames, max);
  if (count > 0) return count;
  const std::int64_t left_us = std::max<std::int64_t>(0, end_us - monotonic_us());
  const bool pollable = bus.fd() >= 0;
  const std::int64_t wait_us = pollable ? left_us : std::min(left_us, kNoDescriptor_us);
  const timespec wait{wait_us / 1'000'000, static_cast<long>(wait_us % 1'000'000) * 1000};
  pollfd descriptor{bus.fd(), POLLIN, 0};
  ppoll(&descriptor, pollable ? 1 : 0, &wait, nullptr);
  return bus.receive(frames, max);
}

}  // namespace internal

namespace {

std::string hex(std::uint32_t code) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08X", static_cast<unsigned>(code));
  return text;
}

constexpr const char* kNoAnswer =
    "no answer. Is the drive powered, the cable in, the bus terminated, the node id right (sprung drive "
    "scan), the interface up? A "
    "lock-step run admits no outsiders: use sprung up --clock realtime";

}  // namespace

std::uint32_t SdoAnswer::number() const noexcept {
  const auto count = static_cast<int>(std::min<std::size_t>(bytes.size(), 4));
  return canopen::get_le(bytes.data(), count);
}

SdoSession::SdoSession(CanBus& bus, int node, double timeout_s)
    : bus_(bus), node_(node), client_(node, std::llround(1e6 * timeout_s)) {}

/// Everything that is due now. A block is longer than an interface's queue: what it does not take is waited
/// for.
/// @return false when the bus takes nothing.
bool SdoSession::send_due() {
  constexpr int kTries = 500;
  CanFrame request;
  while (client_.step(monotonic_us(), request)) {
    int tries = 0;
    while (!bus_.send(&request, 1) && bus_.last_send_error() == CanSendError::kNoBuffers &&
           !stop_requested()) {
      if (++tries == kTries) return false;
      const timespec wait{0, 1'000'000};
      nanosleep(&wait, nullptr);
    }
  }
  return true;
}

SdoAnswer SdoSession::run() {
  constexpr int kBatch = 32;
  constexpr double kTurn_s = 0.001;  // the client looks at its time-out that often
  while (client_.status() == canopen::SdoStatus::kBusy && !stop_requested()) {
    if (!send_due()) break;
    if (client_.status() != canopen::SdoStatus::kBusy) break;
    CanFrame frames[kBatch];
    const int count = internal::wait_and_receive(bus_, internal::end_after(kTurn_s), frames, kBatch);
    for (int i = 0; i < count; ++i) {
      if (!frames[i].error && !frames[i].remote) client_.receive(frames[i]);  // a block comes in a row
    }
  }
  SdoAnswer answer;
  answer.status = client_.status() == canopen::SdoStatus::kBusy ? canopen::SdoStatus::kTimeout
                                                                : client_.status();
  if (answer.done()) answer.bytes.assign(client_.data(), client_.data() + client_.size());
  if (answer.status == canopen::SdoStatus::kAborted) answer.abort_code = client_.abort_code();
  client_.finish();
  return answer;
}

SdoAnswer SdoSession::read(canopen::ObjectId object, canopen::SdoService service) {
  client_.read(object, service);
  return run();
}

SdoAnswer SdoSession::write(canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) {
  client_.write(object, bytes.data(), bytes.size(), canopen::SdoService::kBlock);
  return run();
}

SdoAnswer SdoSession::must_read(canopen::ObjectId object, canopen::SdoService service) {
  SdoAnswer answer = read(object, service);
  if (!answer.done()) fail("reading", object, answer);
  return answer;
}

void SdoSession::must_write(canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) {
  const SdoAnswer answer = write(object, bytes);
  if (!answer.done()) fail("writing", object, answer);
}

void SdoSession::fail(const char* what, canopen::ObjectId object, const SdoAnswer& answer) const {
  const std::string reason = answer.status == canopen::SdoStatus::kAborted
                                 ? "the node refuses: " + hex(answer.abort_code) + " " +
                                       canopen::abort_text(answer.abort_code)
                                 : kNoAnswer;
  throw SdoFailed("node " + std::to_string(node_) + " on " + bus_.describe() + ", " + what + " " +
                  canopen::id_text(object) + ": " + reason);
}

}  // namespace sprung
