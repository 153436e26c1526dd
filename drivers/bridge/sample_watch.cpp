#include "drivers/bridge/sample_watch.h"

#include <algorithm>
#include <utility>

namespace sprung {
namespace {

constexpr std::int64_t kStampError_us = 200;  // [design choice] between the kernel's stamps and our clock
constexpr int kDebtsExpire = 10;              // [design choice] cycles in a row that were answered in time
// [design choice] of silent_cycles: answers that come after their cycle show that a node lives, but nobody
// can control by them
constexpr int kUntimelyShare = 2;

}  // namespace

void SampleWatch::begin(std::int64_t sync_us, bool owes) noexcept {
  last_sync_us_ = std::exchange(sync_us_, sync_us);
  syncs_us_[syncs_++ % kMostOwed] = sync_us;
  catching_up_ = owed_ > 0 && answers_ != 1;
  answers_ = 0;
  answered_ = false;
  sampling_ = true;
  if (owes && owed_ < kMostOwed) ++owed_;
}

/// A frame that the bus repeats is harmless. One that differs is the next of those that the node owes: a
/// device that stalls pays late and in order, but never twice, so the last one is the sample. Beyond what is
/// owed there is another device; what that one can bring in before, after a loss, must follow from where the
/// drive was, as any sample.
Answer SampleWatch::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (answered_ && !is_newer(frame)) {
    ++duplicate_;
    return frame == answer_ ? Answer::kRepeated : Answer::kConflict;
  }
  const bool late = !sampling_ || time_us < sync_us_ - kStampError_us;
  if (late || answered_) ++late_;  // this one, or the one that it replaces
  if (!late) {
    answered_ = true;
    answer_ = frame;
  }
  ++answers_;
  const bool too_early = late && sampling_ && !answered_;  // for this SYNC's answer, which stays owed
  const bool was_owed = owed_ > (too_early ? 1 : 0);
  if (late && !was_owed) return Answer::kUnasked;
  owed_ -= was_owed ? 1 : 0;
  heard_late_ = late;
  return Answer::kSample;
}

void SampleWatch::end(bool accepted, bool owes) noexcept {
  sampling_ = false;
  const bool good = answered_ && accepted;
  punctual_cycles_ = answered_ ? punctual_cycles_ + 1 : 0;
  if (punctual_cycles_ >= kDebtsExpire) owed_ = 0;
  age_cycles_ = good ? 0 : age_cycles_ + 1;
  if (accepted && !answered_) age_cycles_ = std::min(age_cycles_, owed_);
  untimely_cycles_ = good ? 0 : untimely_cycles_ + 1;
  heard_late_ = false;
  if (!good && owes) ++missing_;
}

void SampleWatch::restart() noexcept {
  age_cycles_ = untimely_cycles_ = owed_ = answers_ = punctual_cycles_ = 0;
  catching_up_ = heard_late_ = false;
}

bool SampleWatch::silent() const noexcept {
  return too_old() || untimely_cycles_ > kUntimelyShare * silent_cycles_;
}

std::int64_t SampleWatch::earliest_sync_us() const noexcept {
  const int cycles = std::min({owed_, silent_cycles_, kMostOwed - 1});
  const std::int64_t place = std::max<std::int64_t>(0, syncs_ - 1 - cycles);  // none is older than the first
  return syncs_us_[place % kMostOwed];
}

void SampleWatch::show(NodeHealth& out) const noexcept {
  out.missing_samples = missing_;
  out.late_samples = late_;
  out.duplicate_samples = duplicate_;
}

}  // namespace sprung
