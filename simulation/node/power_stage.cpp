#include "simulation/node/power_stage.h"

#include <cmath>

#include "drivers/cia402/words.h"

namespace sprung::sim {
namespace {

constexpr std::uint16_t kHaltBit = 1U << 8;

/// Codes of 0x605A.
bool stays_after_quick_stop(int option) noexcept { return option >= 5 && option <= 8; }

bool enables(std::uint16_t word) noexcept {
  constexpr std::uint16_t kMask = cia402::kFaultResetBit | cia402::kEnableOperationWord;
  return (word & kMask) == cia402::kEnableOperationWord;
}

}  // namespace

PowerStage::PowerStage(const PowerTimes& times, double step_s) noexcept : times_(times), step_s_(step_s) {
  reset();
}

void PowerStage::reset() noexcept {
  enter(PowerState::kNotReadyToSwitchOn);
  extra_ = times_.start_s > 0.0 ? PowerExtra::kStart : PowerExtra::kNone;
  last_word_ = 0;
  halted_ = false;
  measured_ = times_.refresh_s + times_.measure_s <= 0.0;
}

void PowerStage::enter(PowerState state) noexcept {
  state_ = state;
  after_braking_ = PowerState::kUnknown;
  extra_ = PowerExtra::kNone;
  elapsed_s_ = 0.0;
}

bool PowerStage::powered() const noexcept {
  if (state_ == PowerState::kFaultReactionActive) return brakes_in_fault_;
  return state_ == PowerState::kOperationEnabled || state_ == PowerState::kQuickStopActive;
}

bool PowerStage::braking() const noexcept {
  if (state_ == PowerState::kOperationEnabled) return halted_ || after_braking_ != PowerState::kUnknown;
  return powered();
}

bool PowerStage::has_voltage() const noexcept {
  return powered() || state_ == PowerState::kSwitchedOn || state_ == PowerState::kReadyToSwitchOn;
}

void PowerStage::control(std::uint16_t word, const PowerOptions& options, double velocity_rad_s,
                         bool fault_reset_allowed) noexcept {
  const auto acts = static_cast<std::uint16_t>(fault_reset_allowed ? word : word & ~cia402::kFaultResetBit);
  const PowerState before = state_;
  PowerState next = cia402::apply_control(before, acts, last_word_);
  // Transitions 3 and 4 in one: a word that enables operation goes on through "switched on".
  if (before == PowerState::kReadyToSwitchOn && next == PowerState::kSwitchedOn)
    next = cia402::apply_control(next, acts, last_word_);
  if (before == PowerState::kReadyToSwitchOn && next == PowerState::kOperationEnabled)
    enter(PowerState::kSwitchedOn);
  if (before == PowerState::kQuickStopActive && stays_in_quick_stop_ && enables(acts))
    next = PowerState::kOperationEnabled;
  last_word_ = word;
  halted_ = (word & kHaltBit) != 0;
  const bool operates = before == PowerState::kOperationEnabled;
  if (next == PowerState::kQuickStopActive) {
    if (before != next) quick_stop(options, velocity_rad_s);
  } else if (next == PowerState::kOperationEnabled) {
    after_braking_ = PowerState::kUnknown;
    if (!operates) begin_enable();
  } else if (operates && next == PowerState::kSwitchedOn) {
    leave_operation(next, options.disable != 0, velocity_rad_s);
  } else if (operates && next == PowerState::kReadyToSwitchOn) {
    leave_operation(next, options.shutdown != 0, velocity_rad_s);
  } else if (next != before || extra_ == PowerExtra::kRefresh || extra_ == PowerExtra::kMeasure) {
    enter(next);
  }
}

/// The refresh begins with the first such word; more of them change nothing.
void PowerStage::begin_enable() noexcept {
  if (measured_) return enter(PowerState::kOperationEnabled);
  if (extra_ != PowerExtra::kNone) return;
  extra_ = times_.refresh_s > 0.0 ? PowerExtra::kRefresh : PowerExtra::kMeasure;
  elapsed_s_ = 0.0;
}

void PowerStage::leave_operation(PowerState target, bool brakes, double velocity_rad_s) noexcept {
  if (!brakes || velocity_rad_s == 0.0) return enter(target);
  if (after_braking_ == PowerState::kUnknown) elapsed_s_ = 0.0;
  after_braking_ = target;
}

void PowerStage::quick_stop(const PowerOptions& options, double velocity_rad_s) noexcept {
  stays_in_quick_stop_ = stays_after_quick_stop(options.quick_stop);
  const bool brakes = stays_in_quick_stop_ || (options.quick_stop != 0 && velocity_rad_s != 0.0);
  enter(brakes ? PowerState::kQuickStopActive : PowerState::kSwitchOnDisabled);
}

void PowerStage::fault(bool brakes, double velocity_rad_s) noexcept {
  brakes_in_fault_ = brakes && powered() && velocity_rad_s != 0.0;
  enter(PowerState::kFaultReactionActive);
}

void PowerStage::connection_lost(int abort_option, const PowerOptions& options,
                                 double velocity_rad_s) noexcept {
  if (!has_voltage() || abort_option == 0) return;
  if (abort_option == 1) {
    fault(options.fault_reaction != 0, velocity_rad_s);
  } else if (abort_option == 3 && powered()) {
    quick_stop(options, velocity_rad_s);
  } else {
    enter(PowerState::kSwitchOnDisabled);
  }
}

void PowerStage::advance(double velocity_rad_s) noexcept {
  elapsed_s_ += step_s_;
  if (state_ == PowerState::kNotReadyToSwitchOn || extra_ != PowerExtra::kNone) return advance_extra();
  if (state_ == PowerState::kFaultReactionActive && !brakes_in_fault_) return enter(PowerState::kFault);
  const bool ends = state_ == PowerState::kQuickStopActive || state_ == PowerState::kFaultReactionActive ||
                    after_braking_ != PowerState::kUnknown;
  if (ends) advance_braking(velocity_rad_s);
}

void PowerStage::advance_braking(double velocity_rad_s) noexcept {
  if (state_ == PowerState::kQuickStopActive && stays_in_quick_stop_) return;
  if (std::abs(velocity_rad_s) >= kSlow_rad_s && elapsed_s_ <= kBrakeTime_s) return;
  if (state_ == PowerState::kFaultReactionActive) return enter(PowerState::kFault);
  enter(state_ == PowerState::kQuickStopActive ? PowerState::kSwitchOnDisabled : after_braking_);
}

void PowerStage::advance_extra() noexcept {
  // Half a tick of tolerance: sums of ticks are not exactly the time.
  const auto over = [this](double time_s) { return elapsed_s_ > time_s - 0.5 * step_s_; };
  switch (extra_) {
    case PowerExtra::kStart:
      if (over(times_.start_s)) enter(PowerState::kNotReadyToSwitchOn);
      return;
    case PowerExtra::kRefresh:
      if (!over(times_.refresh_s)) return;
      extra_ = PowerExtra::kMeasure;
      elapsed_s_ = 0.0;
      return;
    case PowerExtra::kMeasure:
      if (!over(times_.measure_s)) return;
      measured_ = true;
      return enter(PowerState::kOperationEnabled);
    case PowerExtra::kNone:
      if (over(times_.not_ready_s)) enter(PowerState::kSwitchOnDisabled);
      return;
  }
}

}  // namespace sprung::sim
