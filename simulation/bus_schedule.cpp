#include "simulation/bus_schedule.h"

#include <algorithm>

namespace sprung::sim {

namespace {

constexpr std::int64_t kSync_us = 55;  ///< SYNC has no data

}  // namespace

void BusSchedule::start_burst(std::int64_t last_sync_us, std::int64_t compute_us, bool late) noexcept {
  late_ = late;
  for (std::size_t bus = 0; bus < free_us_.size(); ++bus) {
    const std::int64_t ready_us = last_sync_us + kSync_us + answers_us_[bus] + compute_us;
    free_us_[bus] = late_ ? std::max(free_us_[bus], ready_us) : ready_us;
  }
}

std::int64_t BusSchedule::acts_us(const BusFrame& frame, std::int64_t sync_us) noexcept {
  std::int64_t& free_us = free_us_[frame.bus];
  free_us += frame_us(frame.frame);
  return late_ ? free_us : std::min(free_us, sync_us);
}

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
