#include "drivers/can/send_confirmations.h"

namespace sprung {

void SendConfirmations::sent(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (size_ == kCapacity) {
    at(0).awaited = false;
    ++unconfirmed_;
    --awaited_;
    drop_done();
  }
  at(size_++) = {frame, time_us, true};
  ++awaited_;
}

std::int64_t SendConfirmations::confirmed(const CanFrame& frame, std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < size_; ++i) {
    Entry& entry = at(i);
    if (!entry.awaited || !(entry.frame == frame)) continue;
    entry.awaited = false;
    --awaited_;
    const std::int64_t waited_us = time_us - entry.time_us;
    drop_done();
    return waited_us;
  }
  return kUnknown;
}

void SendConfirmations::forget() noexcept {
  unconfirmed_ += static_cast<std::int64_t>(awaited_);
  first_ = size_ = awaited_ = 0;
}

/// The oldest entry is always one that is awaited.
void SendConfirmations::drop_done() noexcept {
  while (size_ > 0 && !at(0).awaited) {
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }
}

}  // namespace sprung
