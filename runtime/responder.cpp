#include "runtime/responder.h"

#include <algorithm>

namespace sprung {
namespace {

/// How far a sender's stored answers reach back: it repeats seq - 1 and seq.
constexpr std::int64_t kRepeatDepth = 2;
/// How long a wait for nothing in particular may last.
constexpr std::int64_t kIdleWait_us = 1'000'000;

bool fell_back(const ResponderView& view, std::int64_t answered) noexcept {
  return view.inputs.count > 0 && view.inputs.newest(0) < answered - kRestartGap;
}

}  // namespace

ResponderDecision LockstepResponder::decide(const ResponderView& view) noexcept {
  if (fell_back(view, expected_ - 1)) return restart();
  if (view.repeated && *view.repeated < expected_) return {ResponderAction::kResend, *view.repeated, 0};
  if (!input_is_here(view)) return wait(view.now_us);
  if (!partner_is_here(view)) return wait(view.now_us);
  give_up_us_.reset();
  return {ResponderAction::kStep, expected_++, 0};
}

bool LockstepResponder::input_is_here(const ResponderView& view) noexcept {
  if (view.inputs.has(expected_)) return true;
  const std::int64_t* const next = std::upper_bound(view.inputs.begin(), view.inputs.end(), expected_);
  if (next == view.inputs.end()) {
    give_up_us_.reset();
    return false;
  }
  const bool cannot_come = view.inputs.newest(0) >= expected_ + kRepeatDepth;
  if (!cannot_come && !waited(view.now_us, timing_.timeout_us)) return false;
  counters_.skipped_inputs += *next - expected_;
  expected_ = *next;
  give_up_us_.reset();
  return true;
}

bool LockstepResponder::partner_is_here(const ResponderView& view) noexcept {
  const std::int64_t wanted = expected_ - timing_.partner_lag;
  if (!timing_.has_partner || wanted < 0) return true;
  if (view.partners.has(wanted)) {
    partner_lost_ = false;
    return true;
  }
  if (!waited(view.now_us, partner_lost_ ? timing_.short_timeout_us : timing_.timeout_us)) return false;
  partner_lost_ = true;
  ++counters_.missed_partners;
  return true;
}

bool LockstepResponder::waited(std::int64_t now_us, std::int64_t timeout_us) noexcept {
  if (!give_up_us_) give_up_us_ = now_us + timeout_us;
  return now_us >= *give_up_us_;
}

ResponderDecision LockstepResponder::wait(std::int64_t now_us) const noexcept {
  return {ResponderAction::kWait, -1, give_up_us_.value_or(now_us + kIdleWait_us)};
}

ResponderDecision LockstepResponder::restart() noexcept {
  expected_ = 0;
  partner_lost_ = false;
  give_up_us_.reset();
  ++counters_.restarts;
  return {ResponderAction::kRestart, -1, 0};
}

ResponderDecision RealTimeResponder::decide(const ResponderView& view) noexcept {
  const ResponderDecision wait{ResponderAction::kWait, -1, view.now_us + kIdleWait_us};
  if (view.inputs.count == 0) return wait;
  const std::int64_t newest = view.inputs.newest(0);
  if (answered_ && fell_back(view, *answered_)) {
    answered_.reset();
    ++counters_.restarts;
    return {ResponderAction::kRestart, -1, 0};
  }
  if (answered_ && newest <= *answered_) return wait;
  if (answered_) counters_.skipped_inputs += newest - *answered_ - 1;
  answered_ = newest;
  return {ResponderAction::kStep, newest, 0};
}

}  // namespace sprung
