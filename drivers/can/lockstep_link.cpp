#include "drivers/can/lockstep_link.h"

#include <algorithm>
#include <utility>

namespace sprung {

namespace {
constexpr int kLongestLook = 256;
constexpr std::size_t kOutsiders = 64;
}  // namespace

LockstepLink::LockstepLink(std::unique_ptr<UdpBus> bus, std::vector<BurstFault> faults)
    : bus_(std::move(bus)), faults_(std::move(faults)) {
  outgoing_.reserve(kMaxBurst);
  stored_.reserve(kMaxBurst);
  received_.reserve(kMaxBurst);
}

void LockstepLink::add(const FrameBatch& batch, int bus) noexcept {
  for (const BusFrame& item : batch) {
    if (item.bus != bus) continue;
    if (outgoing_.size() + 1 < static_cast<std::size_t>(kMaxBurst)) {  // one place stays for the mark
      outgoing_.push_back(item.frame);
    } else {
      ++counters_.overflow;
    }
  }
}

void LockstepLink::send_burst(std::int64_t tick) noexcept { send(tick); }

void LockstepLink::send_answer(std::int64_t tick) noexcept {
  outgoing_.push_back(end_of_tick_mark());
  send(tick);
}

void LockstepLink::send(std::int64_t tick) noexcept {
  stored_.clear();
  const int count = static_cast<int>(outgoing_.size());
  for (int i = 0; i < count; ++i) {
    stored_.push_back({outgoing_[i], encode_stamp({tick, count, i})});
  }
  outgoing_.clear();
  ++counters_.bursts_sent;
  if (touched_by_faults(tick)) {
    send_with_faults(tick);
  } else {
    bus_->send_stamped(stored_.data(), count);
  }
}

bool LockstepLink::touched_by_faults(std::int64_t tick) const noexcept {
  return std::any_of(faults_.begin(), faults_.end(),
                     [tick](const BurstFault& fault) { return fault.tick == tick; });
}

void LockstepLink::send_with_faults(std::int64_t tick) noexcept {
  for (std::size_t i = 0; i < stored_.size(); ++i) {
    int copies = 1;
    for (const BurstFault& fault : faults_) {
      if (fault.tick != tick || fault.index != static_cast<int>(i)) continue;
      copies = fault.kind == BurstFault::Kind::kDrop ? 0 : 2;
    }
    for (int copy = 0; copy < copies; ++copy) bus_->send_stamped(&stored_[i], 1);
  }
}

void LockstepLink::resend() noexcept {
  if (stored_.empty()) return;
  ++counters_.resent;
  bus_->send_stamped(stored_.data(), static_cast<int>(stored_.size()));
}

std::vector<CanFrame> LockstepLink::take_outsiders() noexcept { return std::exchange(outsiders_, {}); }

LinkEvent LockstepLink::poll() noexcept {
  StampedFrame stamped;
  // A tool that floods the bus must not keep us here.
  for (int i = 0; i < kLongestLook && bus_->receive_stamped(&stamped, 1) == 1; ++i) {
    BurstStamp stamp;
    if (!decode_stamp(stamped.timestamp, stamp)) {
      ++counters_.unstamped;
      if (outsiders_.size() < kOutsiders) outsiders_.push_back(stamped.frame);
      continue;
    }
    const BurstEvent event = assembler_.add(stamp, stamped.frame);
    if (event == BurstEvent::kRepeat) return LinkEvent::kRepeat;
    if (event != BurstEvent::kComplete) continue;
    ++counters_.bursts_received;
    received_ = assembler_.frames();
    if (!received_.empty() && is_end_of_tick_mark(received_.back())) received_.pop_back();
    return LinkEvent::kComplete;
  }
  return LinkEvent::kNothing;
}

}  // namespace sprung
