#pragma once
/// Lock-step bursts over a medium that may drop, repeat or reorder datagrams: numbering and assembling. Pure.
///
/// Every frame carries an integer in the double `timestamp` of its datagram:
///   tick * 2^20 + count * 2^10 + index      count = frames in this burst, 1..1000; index = 0..count-1
/// exact up to tick 2^33. The bridge's burst of tick k is all frames since the last SYNC with the SYNC last;
/// the drives' answer of tick k is what they sent, closed by an end-of-tick mark, so that an empty answer can
/// be seen too.
#include <cstdint>
#include <vector>

#include "drivers/can/can_frame.h"

namespace sprung {

struct BurstStamp {
  std::int64_t tick = 0;
  int count = 0;
  int index = 0;
};

inline constexpr int kMaxBurst = 1000;

double encode_stamp(const BurstStamp& stamp) noexcept;
/// @return false on a number that encode_stamp cannot have made, e.g. the 0.0 of a tool that joined the bus.
bool decode_stamp(double timestamp, BurstStamp& stamp) noexcept;

/// Closes an answer: an error frame with id 0, which no CAN controller reports.
CanFrame end_of_tick_mark() noexcept;
bool is_end_of_tick_mark(const CanFrame& frame) noexcept;

enum class BurstEvent : std::int8_t {
  kPartial,   ///< more to come, or a duplicate
  kComplete,  ///< frames() and tick() hold a new burst
  kRepeat,    ///< a burst of a tick already completed was sent again: its answer was lost on the way
};

/// Collects the frames of one tick at a time; ticks only go forward.
class BurstAssembler {
 public:
  BurstAssembler();
  /// Treats all ticks before `tick` as done: a late answer of a tick given up can no longer begin a burst.
  void expect(std::int64_t tick) noexcept;
  /// A repeat is reported once a burst, at its last frame.
  BurstEvent add(const BurstStamp& stamp, const CanFrame& frame) noexcept;
  std::int64_t tick() const noexcept { return done_tick_; }  ///< of the last complete burst, -1 = none
  const std::vector<CanFrame>& frames() const noexcept { return complete_; }  ///< in index order

 private:
  void begin(const BurstStamp& stamp) noexcept;

  std::vector<CanFrame> partial_;
  std::vector<bool> have_;
  std::vector<CanFrame> complete_;
  int missing_ = 0;
  std::int64_t tick_ = -1;       ///< being assembled
  std::int64_t done_tick_ = -1;  ///< last complete one
  std::int64_t floor_ = 0;       ///< first tick that may begin a burst
};

}  // namespace sprung
