#include "tools/can/decode/repeat_filter.h"

#include <algorithm>

namespace sprung::cantools {
namespace {

constexpr std::int64_t kKept = 16;     // ticks; only the last burst of each side is ever sent again
constexpr std::int64_t kNewRun = 256;  // a tick so far back is another run's on the same address

}  // namespace

bool RepeatFilter::is_new(const StampedFrame& stamped) {
  BurstStamp stamp;
  if (is_end_of_tick_mark(stamped.frame)) return false;
  if (!decode_stamp(stamped.timestamp, stamp)) return true;
  if (stamp.tick + kNewRun < newest_) {
    seen_.clear();
    newest_ = -1;
  }
  if (stamp.tick + kKept < newest_) return false;
  newest_ = std::max(newest_, stamp.tick);
  forget_before(newest_ - kKept);
  return seen_.insert({stamp.tick, stamp.count, stamp.index, stamped.frame.id, stamped.frame.remote}).second;
}

void RepeatFilter::forget_before(std::int64_t tick) {
  seen_.erase(seen_.begin(), seen_.lower_bound({tick, 0, 0, 0, false}));
}

}  // namespace sprung::cantools
