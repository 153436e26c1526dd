#include "tools/logs/recorder/gap_tracker.h"

#include <algorithm>

#include "lcmtypes/channels.h"
#include "runtime/slot.h"

namespace sprung {

bool has_every_cycle(std::string_view channel) noexcept {
  using namespace channels;
  const std::string_view cyclic[] = {kDriveState,  kJointState, kLegCommand, kDriveCommand,
                                     kMotionState, kCanTrace,   kSimTruth,   kImu};
  return std::find(std::begin(cyclic), std::end(cyclic), channel) != std::end(cyclic);
}

std::int64_t GapTracker::add(std::int64_t seq) noexcept {
  ++counts_.messages;
  if (seq < 0 || seq > kLastCycle) return 0;
  if (newest_ && seq < *newest_ - kRestartGap) {
    ++counts_.restarts;
    newest_.reset();
  }
  if (newest_ && seq <= *newest_) {
    came_late(seq);
    return 0;
  }
  return came_ahead(seq);
}

void GapTracker::came_late(std::int64_t seq) noexcept {
  if (*newest_ - seq >= kWindow || seen_[place(seq)]) {
    ++counts_.repeats;
    return;
  }
  seen_.set(place(seq));
  --counts_.missing;
}

std::int64_t GapTracker::came_ahead(std::int64_t seq) noexcept {
  const std::int64_t skipped = newest_ ? seq - *newest_ - 1 : 0;
  if (!newest_) {
    seen_.set();  // what came before the first message is not missing
  } else {
    for (std::int64_t k = std::max(*newest_ + 1, seq - kWindow); k < seq; ++k) seen_.reset(place(k));
  }
  seen_.set(place(seq));
  if (skipped > 0) {
    if (counts_.gaps++ == 0) counts_.first_missing = *newest_ + 1;
    counts_.missing += skipped;
  }
  newest_ = seq;
  return skipped;
}

GapCounts SessionGapTracker::counts() const noexcept {
  GapCounts sum;
  for (const auto& [session, tracker] : sessions_) {
    const GapCounts& one = tracker.counts();
    sum.messages += one.messages;
    sum.repeats += one.repeats;
    if (sum.gaps == 0) sum.first_missing = one.first_missing;
    sum.gaps += one.gaps;
    sum.missing += one.missing;
    sum.restarts += one.restarts;
  }
  return sum;
}

}  // namespace sprung
