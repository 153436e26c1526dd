#include "simulation/frame_queue.h"

#include <algorithm>

namespace sprung::sim {

bool FrameQueue::push(const TimedFrame& frame) noexcept {
  if (frames_.size() == kCapacity) return false;
  const auto later = [](const TimedFrame& kept, const TimedFrame& added) {
    return kept.time_us > added.time_us;
  };
  frames_.insert(std::lower_bound(frames_.begin(), frames_.end(), frame, later), frame);
  return true;
}

TimedFrame FrameQueue::pop() noexcept {
  const TimedFrame next = frames_.back();
  frames_.pop_back();
  return next;
}

}  // namespace sprung::sim
