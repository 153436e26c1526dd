#include "drivers/bridge/safety_machine.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// [design choice] a leg at 12 Nm s/rad has come to rest well before.
constexpr double kShutdownDamping_s = 1.0;
/// Design section 8: a robot that still moves is not dropped sooner.
constexpr double kLongestDamping_s = 5.0;
/// By which the leg controller may be late; design section 8 has 1.5 s for the whole.
constexpr double kLoweringMargin_s = 0.3;
// [design choice] a standing leg starts from rest: it must get the time to begin to sink, else it is dropped
constexpr double kSlowLongEnough_s = 0.3;

Fault fault_of(SafetyCause cause, const char* detail) noexcept {
  Fault fault;
  fault.cause = cause;
  print(fault.detail, "%s", detail);
  return fault;
}

Fault command_fault(const SafetyInputs& inputs) noexcept {
  Fault fault;
  if (inputs.command_refused && inputs.refusal != nullptr) {
    fault.cause = SafetyCause::kCommandRefused;
    fault.detail = *inputs.refusal;
  } else {
    fault.cause = SafetyCause::kCommandStale;
    print(fault.detail, "no good DRIVE_COMMAND for %.0f ms", 1e3 * inputs.command_age_s);
  }
  return fault;
}

}  // namespace

SafetyMachine::SafetyMachine(const WatchdogConfig& watchdogs, double lowering_s)
    : watchdogs_(watchdogs), lowering_s_(lowering_s) {
  enter(SafetyLevel::kDisabled, false, fault_of(SafetyCause::kStarting, "drives are being configured"), 0,
        -1);
}

void SafetyMachine::enter(SafetyLevel level, bool latched, const Fault& fault, std::int64_t time_us,
                          std::int64_t cycle) noexcept {
  if (level != state_.level) since_us_ = time_us;
  if (fault.cause != state_.cause) state_.since_seq = cycle;
  state_.level = level;
  state_.cause = fault.cause;
  state_.latched = latched;
  state_.actuator = fault.actuator;
  state_.detail = fault.detail;
  unexplained_ = fault.unexplained;
  if (level == SafetyLevel::kDamping && !latched) keep_past();
}

void SafetyMachine::keep_past() noexcept {
  print(past_, "was damping in cycle %lld, %s: %s", static_cast<long long>(state_.since_seq),
        name(state_.cause), state_.detail.data());
}

void SafetyMachine::latch(SafetyLevel level, const Fault& fault, const SafetyInputs& inputs) noexcept {
  if (!state_.latched) slow_since_us_ = inputs.time_us;
  const bool worse = severity(level) > severity(state_.level);
  enter(worse ? level : state_.level, true, fault, inputs.time_us, inputs.cycle);
}

bool SafetyMachine::lasted(double duration_s, std::int64_t time_us) const noexcept {
  return time_us - since_us_ >= std::llround(1e6 * duration_s);
}

void SafetyMachine::emergency_stop(std::int64_t time_us, std::int64_t cycle, const Fault* fault) noexcept {
  enter(SafetyLevel::kDisabled, true,
        fault != nullptr ? *fault : fault_of(SafetyCause::kEmergencyStop, "emergency stop by the operator"),
        time_us, cycle);
}

void SafetyMachine::refuse_drive(const Fault& fault, std::int64_t time_us, std::int64_t cycle) noexcept {
  if (state_.latched && state_.cause != SafetyCause::kDriveRefused) {
    if (cycle >= 0) state_.detail = fault.detail;  // what to mend before clear can succeed
    return;
  }
  enter(SafetyLevel::kDisabled, true, fault, time_us, cycle);
}

void SafetyMachine::begin_shutdown(std::int64_t time_us, std::int64_t cycle) noexcept {
  const bool powered = severity(state_.level) <= severity(SafetyLevel::kDamping);
  if (!powered && state_.latched) return;  // a stop under way ends without power anyway
  enter(powered ? SafetyLevel::kDamping : SafetyLevel::kDisabled, true,
        fault_of(SafetyCause::kShutdown, "orderly shutdown"), time_us, cycle);
  slow_since_us_ = time_us;
}

void SafetyMachine::clear(std::int64_t time_us, std::int64_t cycle) noexcept {
  forget_past();
  enter(SafetyLevel::kDisabled, false, fault_of(SafetyCause::kStarting, "cleared by the operator"), time_us,
        cycle);
}

void SafetyMachine::update(const SafetyInputs& inputs) noexcept {
  if (state_.latched) {
    worsen(inputs);
  } else if (inputs.bus != nullptr) {
    latch(SafetyLevel::kQuickStop, *inputs.bus, inputs);
  } else if (inputs.drive != nullptr) {
    latch(SafetyLevel::kDamping, *inputs.drive, inputs);
  } else if (inputs.planner != nullptr) {
    latch(SafetyLevel::kLowering, *inputs.planner, inputs);
  } else if (!inputs.armed) {
    enter(SafetyLevel::kDisabled, false,
          fault_of(SafetyCause::kStarting, "waiting for a DRIVE_COMMAND with every mode disabled"),
          inputs.time_us, inputs.cycle);
  } else {
    follow_commands(inputs);
  }
}

void SafetyMachine::explain(const SafetyInputs& inputs) noexcept {
  const Fault* const now = inputs.drive;
  if (!unexplained_ || now == nullptr || now->unexplained) return;
  if (now->cause != state_.cause || now->actuator != state_.actuator) return;
  state_.detail = now->detail;
  unexplained_ = false;
}

void SafetyMachine::worsen(const SafetyInputs& inputs) noexcept {
  explain(inputs);
  if (severity(state_.level) > severity(SafetyLevel::kDamping)) return;
  if (inputs.bus != nullptr) {
    latch(SafetyLevel::kQuickStop, *inputs.bus, inputs);
    return;
  }
  if (state_.level == SafetyLevel::kLowering) {
    lower(inputs);
    return;
  }
  if (!inputs.slow) slow_since_us_ = inputs.time_us;
  const bool slow_long_enough = inputs.time_us - slow_since_us_ >= std::llround(1e6 * kSlowLongEnough_s);
  const bool shutdown = state_.cause == SafetyCause::kShutdown;
  if (!slow_long_enough && !lasted(shutdown ? kShutdownDamping_s : kLongestDamping_s, inputs.time_us)) return;
  state_.level = shutdown ? SafetyLevel::kDisabled : SafetyLevel::kQuickStop;
  since_us_ = inputs.time_us;
}

/// Its end is damping, which a robot that sits outlasts by the time of rest alone.
void SafetyMachine::lower(const SafetyInputs& inputs) noexcept {
  if (inputs.drive != nullptr) {
    latch(SafetyLevel::kDamping, *inputs.drive, inputs);
  } else if (inputs.command_age_s > watchdogs_.command_hold_s || inputs.command_expired ||
             lasted(lowering_s_ + kLoweringMargin_s, inputs.time_us)) {
    state_.level = SafetyLevel::kDamping;
    since_us_ = inputs.time_us;
  } else {
    return;
  }
  slow_since_us_ = inputs.time_us;
}

void SafetyMachine::follow_commands(const SafetyInputs& inputs) noexcept {
  if (inputs.command_age_s > watchdogs_.command_stop_s) {
    latch(SafetyLevel::kQuickStop, command_fault(inputs), inputs);
  } else if (inputs.command_age_s > watchdogs_.command_hold_s || inputs.command_expired) {
    enter(SafetyLevel::kDamping, false, command_fault(inputs), inputs.time_us, inputs.cycle);
  } else if (inputs.overruns_in_row >= watchdogs_.overruns_in_row) {
    enter(SafetyLevel::kDamping, false, fault_of(SafetyCause::kOverruns, "too many cycles in a row overran"),
          inputs.time_us, inputs.cycle);
  } else if (state_.level != SafetyLevel::kOperational || !past_is_told_) {
    enter(SafetyLevel::kOperational, false, {SafetyCause::kNone, -1, past_}, inputs.time_us, inputs.cycle);
    past_is_told_ = true;
  }
}

}  // namespace sprung
