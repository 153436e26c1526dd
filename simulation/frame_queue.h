#pragma once
/// Frames from the master, each kept until the time at which it acts; those of one time in the order in which
/// they came.
#include <cstdint>
#include <limits>
#include <vector>

#include "drivers/can/can_frame.h"

namespace sprung::sim {

struct TimedFrame {
  std::int64_t time_us = 0;
  int bus = 0;
  CanFrame frame;
};

class FrameQueue {
 public:
  static constexpr std::size_t kCapacity = std::size_t{4} * FrameBatch::kCapacity;
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  FrameQueue() { frames_.reserve(kCapacity); }
  /// @return false when full: the frame is lost.
  bool push(const TimedFrame& frame) noexcept;
  std::int64_t next_us() const noexcept { return frames_.empty() ? kNever : frames_.back().time_us; }
  /// The next one; only when next_us() is not kNever.
  TimedFrame pop() noexcept;

 private:
  std::vector<TimedFrame> frames_;  ///< latest first, so that taking the next one moves nothing
};

}  // namespace sprung::sim
