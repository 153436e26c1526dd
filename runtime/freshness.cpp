#include "runtime/freshness.h"

#include <algorithm>

namespace sprung {

Refusal by_clock(std::int64_t utime_us, const std::optional<std::int64_t>& now_us) noexcept {
  if (!now_us) return Refusal::kNone;
  if (utime_us > *now_us + kMostAhead_us) return Refusal::kFuture;
  return utime_us < *now_us - kOldest_us ? Refusal::kLate : Refusal::kNone;
}

Refusal CycleFreshness::admit(const Stamp& stamp, const std::optional<std::int64_t>& now_us) noexcept {
  Refusal refusal = by_clock(stamp.utime_us, now_us);
  if (refusal == Refusal::kNone && any_) refusal = judge(stamp, !now_us);
  if (refusal == Refusal::kNone) take(stamp);
  return refusal;
}

Refusal CycleFreshness::judge(const Stamp& stamp, bool repeats_pass) const noexcept {
  const bool is_newest = stamp.seq > newest_.seq;
  if (is_newest) return stamp.utime_us < newest_.utime_us ? Refusal::kReplayed : Refusal::kNone;
  const std::int64_t back = newest_.seq - stamp.seq;
  if (back > kRestartGap) return stamp.utime_us > newest_.utime_us ? Refusal::kNone : Refusal::kReplayed;
  if (stamp.utime_us < began_us_) return Refusal::kReplayed;
  const bool taken = (taken_ >> back & 1U) != 0;
  return taken && !repeats_pass ? Refusal::kReplayed : Refusal::kNone;
}

void CycleFreshness::take(const Stamp& stamp) noexcept {
  const std::int64_t back = newest_.seq - stamp.seq;
  if (!any_ || back > kRestartGap) {
    any_ = true;
    newest_ = stamp;
    began_us_ = stamp.utime_us;
    taken_ = 1;
  } else if (back < 0) {
    newest_ = stamp;
    taken_ = (back < -kRestartGap ? 0 : taken_ << -back) | 1U;
  } else {
    newest_.utime_us = std::max(newest_.utime_us, stamp.utime_us);
    taken_ |= 1U << back;
  }
}

Refusal EventFreshness::admit(std::int64_t utime_us, std::uint64_t mac, std::int64_t now_us) noexcept {
  const Refusal refusal = by_clock(utime_us, now_us);
  if (refusal != Refusal::kNone) return refusal;
  if (forgotten_us_ && utime_us <= *forgotten_us_) return Refusal::kLate;
  const auto end = known_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kRemembered));
  const bool known = std::any_of(known_.begin(), end, [&](const Known& one) { return one.mac == mac; });
  if (known) return repeats_pass_ ? Refusal::kNone : Refusal::kReplayed;
  remember({mac, utime_us});
  return Refusal::kNone;
}

void EventFreshness::remember(const Known& known) noexcept {
  Known& place = known_[count_ % kRemembered];
  if (count_ >= kRemembered) forgotten_us_ = std::max(place.utime_us, forgotten_us_.value_or(place.utime_us));
  place = known;
  ++count_;
}

}  // namespace sprung
