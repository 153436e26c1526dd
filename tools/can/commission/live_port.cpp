#include "tools/can/commission/live_port.h"

#include <algorithm>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_frames.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/can/node_inspection.h"

namespace sprung::commission {
namespace {

constexpr std::int64_t kReply_us = 250'000;  ///< longer than the drive's own watch of this master
constexpr double kLook_s = 0.001;

}  // namespace

void LivePort::hear(const CanFrame& frame) {
  if (frame.error || frame.remote) return;
  const int node = static_cast<int>(frame.id) - static_cast<int>(canopen::heartbeat_id(0));
  const bool boot_up = node > 0 && node < static_cast<int>(boot_ups_.size()) &&
                       canopen::heartbeat_state(frame) == canopen::NmtState::kBootUp;
  if (boot_up) ++boot_ups_[static_cast<std::size_t>(node)];
}

/// Goes on after Ctrl-C: the words that switch power off are transfers too. Nothing beats meanwhile: a drive
/// with power that does not answer hears no heartbeat either, and switches off by its own watch.
SdoAnswer LivePort::transfer(canopen::SdoClient& client) {
  while (client.status() == canopen::SdoStatus::kBusy) {
    CanFrame request;
    while (client.step(monotonic_us(), request)) bus_.send(&request, 1);
    if (client.status() != canopen::SdoStatus::kBusy) break;
    CanFrame frames[32];
    const int count = internal::wait_and_receive(bus_, internal::end_after(kLook_s), frames, 32);
    for (int i = 0; i < count; ++i) {
      hear(frames[i]);
      client.receive(frames[i]);
    }
  }
  SdoAnswer answer;
  answer.status = client.status();
  if (answer.done()) answer.bytes.assign(client.data(), client.data() + client.size());
  if (answer.status == canopen::SdoStatus::kAborted) answer.abort_code = client.abort_code();
  return answer;
}

SdoAnswer LivePort::read(int node, canopen::ObjectId object) {
  canopen::SdoClient client(node, kReply_us);
  client.read(object);
  return transfer(client);
}

SdoAnswer LivePort::write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) {
  canopen::SdoClient client(node, kReply_us);
  client.write(object, bytes.data(), bytes.size());
  return transfer(client);
}

void LivePort::beat() {
  const std::int64_t now_us = monotonic_us();
  if (now_us < next_beat_us_) return;
  next_beat_us_ = now_us + static_cast<std::int64_t>(1e6 * kCycle_s);
  CanFrame frames[2];
  frames[0].id = canopen::kSyncId;
  frames[1] = canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational);
  bus_.send(frames, 2);
}

void LivePort::wait(double seconds) {
  const std::int64_t end_us = internal::end_after(seconds);
  while (monotonic_us() < end_us) {
    beat();
    CanFrame frames[32];
    const int count = internal::wait_and_receive(bus_, std::min(end_us, internal::end_after(kLook_s)), frames,
                                                 32);
    for (int i = 0; i < count; ++i) hear(frames[i]);
  }
}

double LivePort::now_s() const { return 1e-6 * static_cast<double>(monotonic_us()); }

std::vector<int> LivePort::nodes() {
  std::vector<int> found;
  for (const FoundNode& one : scan_nodes(bus_))
    found.insert(found.end(), static_cast<std::size_t>(one.answers), one.node);
  return found;
}

bool LivePort::stopped() const { return stop_requested(); }

}  // namespace sprung::commission
