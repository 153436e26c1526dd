#include "drivers/bridge/power_control.h"

namespace sprung {
namespace {

using cia402::PowerTarget;

constexpr std::int64_t kRepeat_us = 100'000;          // design section 5: RPDO2 at 10 Hz
constexpr std::int64_t kQuickStopLimit_us = 500'000;  // then the power goes, stopped or not
/// Each half of a reset edge, long enough for a drive to notice.
constexpr std::int64_t kFaultResetStep_us = 20'000;

}  // namespace

void PowerControl::set_target(PowerTarget target, std::int64_t time_us) noexcept {
  if (target == PowerTarget::kQuickStop && target_ != PowerTarget::kQuickStop) quick_stop_since_us_ = time_us;
  target_ = target;
}

void PowerControl::reset_faults(bool reset) noexcept {
  reset_faults_ = reset;
  if (reset) lost_power_ = reached_enabled_ = false;
}

void PowerControl::observe(PowerState state) noexcept {
  lost_power_ = lost_power_ || (reached_enabled_ && state != PowerState::kOperationEnabled);
}

std::uint16_t PowerControl::next_word(PowerState state, std::int64_t time_us) noexcept {
  if (state == PowerState::kFault && reset_faults_) {
    return time_us - sent_us_ < kFaultResetStep_us ? sent_word_ : cia402::fault_reset_word(sent_word_);
  }
  const bool stopped_long_enough = target_ == PowerTarget::kQuickStop &&
                                   time_us - quick_stop_since_us_ >= kQuickStopLimit_us;
  return cia402::next_control_word(state, stopped_long_enough ? PowerTarget::kOff : target_);
}

bool PowerControl::step(PowerState state, std::int64_t time_us, std::uint16_t& word) noexcept {
  const bool wants_enabled = target_ == PowerTarget::kEnabled;
  // Only a state seen after it was wanted counts: one sampled before may still be on its way down.
  const bool reached = reached_enabled_ || (wanted_enabled_ && state == PowerState::kOperationEnabled);
  reached_enabled_ = wants_enabled && reached;
  wanted_enabled_ = wants_enabled;
  word = next_word(state, time_us);
  if (sent_any_ && word == sent_word_ && time_us - sent_us_ < kRepeat_us) return false;
  sent_any_ = true;
  sent_word_ = word;
  sent_us_ = time_us;
  return true;
}

}  // namespace sprung
