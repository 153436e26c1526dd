#include "tools/station/server/held_motion.h"

namespace sprung::station {
namespace {

constexpr std::int64_t kLapse_us = 50'000;  // until the planner has seen it

OperatorCommand hold(double hold_s) {
  OperatorCommand command;
  command.kind = OperatorKind::kHold;
  command.hold_s = hold_s;
  return command;
}

}  // namespace

void HeldMotion::begin(std::int64_t now_us) noexcept {
  forget();
  active_ = true;
  touch(now_us);
  renewed(now_us);
}

void HeldMotion::let_go(std::int64_t now_us) noexcept {
  if (!active_) return;
  active_ = false;
  last_word_ = true;
  stop_us_ = now_us + kLapse_us;
}

void HeldMotion::forget() noexcept {
  active_ = false;
  last_word_ = false;
  stop_us_ = kNone;
}

void HeldMotion::step(std::int64_t now_us, std::vector<OperatorCommand>& say) {
  if (active_ && now_us - touched_us_ > kGone_us) let_go(now_us);
  if (active_ && now_us >= renew_us_) {
    say.push_back(hold(kHold_s));
    renewed(now_us);
  }
  if (last_word_) say.push_back(hold(HeldMotion::kLetGo_s));
  last_word_ = false;
  if (stop_us_ == kNone || now_us < stop_us_) return;
  stop_us_ = kNone;
  OperatorCommand stop;
  stop.kind = OperatorKind::kStop;
  say.push_back(stop);
}

}  // namespace sprung::station
