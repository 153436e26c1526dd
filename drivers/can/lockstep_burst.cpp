#include "drivers/can/lockstep_burst.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kLargestExact = 9007199254740992.0;  // 2^53
constexpr std::int64_t kField = 1 << 10;

}  // namespace

double encode_stamp(const BurstStamp& stamp) noexcept {
  return static_cast<double>(stamp.tick * kField * kField + stamp.count * kField + stamp.index);
}

bool decode_stamp(double timestamp, BurstStamp& stamp) noexcept {
  if (!(timestamp >= 0.0 && timestamp < kLargestExact) || timestamp != std::floor(timestamp)) return false;
  const auto word = static_cast<std::int64_t>(timestamp);
  stamp.tick = word / (kField * kField);
  stamp.count = static_cast<int>(word / kField % kField);
  stamp.index = static_cast<int>(word % kField);
  return stamp.count >= 1 && stamp.count <= kMaxBurst && stamp.index < stamp.count;
}

CanFrame end_of_tick_mark() noexcept {
  CanFrame frame;
  frame.error = true;
  return frame;
}

bool is_end_of_tick_mark(const CanFrame& frame) noexcept { return frame == end_of_tick_mark(); }

BurstAssembler::BurstAssembler() {
  partial_.reserve(kMaxBurst);
  have_.reserve(kMaxBurst);
  complete_.reserve(kMaxBurst);
}

void BurstAssembler::expect(std::int64_t tick) noexcept {
  floor_ = std::max(floor_, tick);
  if (tick_ < floor_) missing_ = 0;
}

void BurstAssembler::begin(const BurstStamp& stamp) noexcept {
  tick_ = stamp.tick;
  missing_ = stamp.count;
  partial_.assign(static_cast<std::size_t>(stamp.count), CanFrame());
  have_.assign(static_cast<std::size_t>(stamp.count), false);
}

BurstEvent BurstAssembler::add(const BurstStamp& stamp, const CanFrame& frame) noexcept {
  if (stamp.tick < floor_) {
    const bool last = stamp.tick == done_tick_ && stamp.index == stamp.count - 1;
    return last ? BurstEvent::kRepeat : BurstEvent::kPartial;
  }
  if (stamp.tick < tick_) return BurstEvent::kPartial;
  if (stamp.tick > tick_) begin(stamp);
  const auto index = static_cast<std::size_t>(stamp.index);
  if (static_cast<std::size_t>(stamp.count) != partial_.size() || have_[index]) return BurstEvent::kPartial;
  have_[index] = true;
  partial_[index] = frame;
  if (--missing_ > 0) return BurstEvent::kPartial;
  complete_.swap(partial_);
  done_tick_ = tick_;
  floor_ = tick_ + 1;
  return BurstEvent::kComplete;
}

}  // namespace sprung
