#include "drivers/bridge/guard_watch.h"

namespace sprung {

void GuardWatch::restart() noexcept {
  unanswered_ = 0;
  either_ = expected_ = wrong_ = false;
}

bool GuardWatch::due(std::int64_t time_us, std::int64_t cycle_us) noexcept {
  if (!guarded_ || time_us + cycle_us <= next_us_) return false;
  next_us_ = time_us + period_us_;
  // Question or answer was lost, and only in the second case has the node toggled.
  either_ = either_ || unanswered_ > 0;
  ++unanswered_;
  return true;
}

bool GuardWatch::answered(const canopen::GuardReply& reply) noexcept {
  if (!guarded_) return true;
  if (reply.state == canopen::NmtState::kBootUp) {
    restart();
    return true;
  }
  wrong_ = !either_ && reply.toggle != expected_;
  errors_ += wrong_ ? 1 : 0;
  expected_ = !reply.toggle;
  either_ = false;
  unanswered_ = 0;
  return !wrong_;
}

}  // namespace sprung
