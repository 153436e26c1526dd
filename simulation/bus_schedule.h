#pragma once
/// Bus time of classic CAN at 1 Mbit/s, when a burst's frames act (facts canopen 6.1), and where they wait
/// until then.
#include <cstdint>
#include <limits>
#include <vector>

#include "drivers/can/can_frame.h"

namespace sprung::sim {

/// Longest time on the wire: 55 + 10 n us for n data bytes, stuffing and pause included.
constexpr std::int64_t frame_us(const CanFrame& frame) noexcept { return 55 + 10 * frame.length; }

/// After a SYNC: the drives' answers, the stack's compute time, then the burst's frames one after the other
/// on each bus.
class BusSchedule {
 public:
  explicit BusSchedule(std::size_t buses) : answers_us_(buses), free_us_(buses) {}
  void start_answers(int bus) noexcept { answers_us_[bus] = 0; }
  void add_answer(const BusFrame& answer) noexcept { answers_us_[answer.bus] += frame_us(answer.frame); }
  /// A burst begins: when each bus is free for it. @param compute_us from the last answer on.
  /// @param late its frames may act after the next SYNC, and it waits for the burst before; else they come
  /// with that SYNC at last.
  void start_burst(std::int64_t last_sync_us, std::int64_t compute_us, bool late = false) noexcept;
  /// When this frame of the burst acts, that is at its end on the wire; unless `late` never after sync_us.
  std::int64_t acts_us(const BusFrame& frame, std::int64_t sync_us) noexcept;

 private:
  bool late_ = false;
  std::vector<std::int64_t> answers_us_;  ///< bus time of the answers to the last SYNC
  std::vector<std::int64_t> free_us_;
};

struct TimedFrame {
  std::int64_t time_us = 0;
  int bus = 0;
  CanFrame frame;
};

/// Frames from the master, each kept until the time at which it acts; those of one time in the order in which
/// they came.
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
