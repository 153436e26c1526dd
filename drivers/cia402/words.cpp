#include "drivers/cia402/words.h"

namespace sprung::cia402 {
namespace {

constexpr std::uint16_t kWideMask = 0x4F;  ///< states that do not look at the quick stop bit
constexpr std::uint16_t kFullMask = 0x6F;
constexpr std::uint16_t kCommandMask = 0x0F;

bool has(std::uint16_t word, std::uint16_t bits) noexcept { return (word & bits) == bits; }

/// A command that takes the voltage away: enable voltage (bit 1) is off.
bool disables_voltage(std::uint16_t word) noexcept { return !has(word, 0x02); }
/// Enable voltage on, quick stop (active low, bit 2) asked for.
bool quick_stops(std::uint16_t word) noexcept { return (word & 0x06) == 0x02; }

PowerState without_fault(PowerState state, std::uint16_t word) noexcept {
  const bool switched_on = has(word, kSwitchOnWord);
  const bool enable = has(word, kEnableOperationWord);
  switch (state) {
    case PowerState::kSwitchOnDisabled:
      return (word & 0x07) == kShutdownWord ? PowerState::kReadyToSwitchOn : state;
    case PowerState::kReadyToSwitchOn:
      return switched_on ? PowerState::kSwitchedOn : state;
    case PowerState::kSwitchedOn:
      if (enable) return PowerState::kOperationEnabled;
      return switched_on ? state : PowerState::kReadyToSwitchOn;
    case PowerState::kOperationEnabled:
      if (enable) return state;
      return switched_on ? PowerState::kSwitchedOn : PowerState::kReadyToSwitchOn;
    default:
      return state;
  }
}

}  // namespace

PowerState decode_status(std::uint16_t status_word) noexcept {
  switch (status_word & kWideMask) {
    case 0x00:
      return PowerState::kNotReadyToSwitchOn;
    case 0x40:
      return PowerState::kSwitchOnDisabled;
    case 0x0F:
      return PowerState::kFaultReactionActive;
    case 0x08:
      return PowerState::kFault;
    default:
      break;
  }
  switch (status_word & kFullMask) {
    case 0x21:
      return PowerState::kReadyToSwitchOn;
    case 0x23:
      return PowerState::kSwitchedOn;
    case 0x27:
      return PowerState::kOperationEnabled;
    case 0x07:
      return PowerState::kQuickStopActive;
    default:
      return PowerState::kUnknown;
  }
}

std::uint16_t encode_status(PowerState state) noexcept {
  switch (state) {
    case PowerState::kSwitchOnDisabled:
      return kSwitchOnDisabledBit;
    case PowerState::kReadyToSwitchOn:
      return 0x21;
    case PowerState::kSwitchedOn:
      return 0x23 | kVoltageEnabledBit;
    case PowerState::kOperationEnabled:
      return 0x27 | kVoltageEnabledBit;
    case PowerState::kQuickStopActive:
      return 0x07 | kVoltageEnabledBit;
    case PowerState::kFaultReactionActive:
      return 0x0F | kVoltageEnabledBit;
    case PowerState::kFault:
      return 0x08;
    case PowerState::kUnknown:
    case PowerState::kNotReadyToSwitchOn:
      break;
  }
  return 0;
}

PowerState apply_control(PowerState state, std::uint16_t control_word, std::uint16_t previous) noexcept {
  if (state == PowerState::kFault) {
    const bool edge = has(control_word, kFaultResetBit) && !has(previous, kFaultResetBit);
    return edge ? PowerState::kSwitchOnDisabled : state;
  }
  if (state == PowerState::kUnknown || state == PowerState::kNotReadyToSwitchOn ||
      state == PowerState::kFaultReactionActive) {
    return state;
  }
  if (has(control_word, kFaultResetBit)) return state;  // no other command is in such a word (mask 0x8F)
  if (disables_voltage(control_word)) return PowerState::kSwitchOnDisabled;
  if (quick_stops(control_word)) {
    const bool moving = state == PowerState::kOperationEnabled || state == PowerState::kQuickStopActive;
    return moving ? PowerState::kQuickStopActive : PowerState::kSwitchOnDisabled;
  }
  return without_fault(state, control_word & kCommandMask);
}

std::uint16_t next_control_word(PowerState state, PowerTarget target) noexcept {
  if (target == PowerTarget::kOff) return kDisableVoltageWord;
  if (target == PowerTarget::kQuickStop) {
    const bool moving = state == PowerState::kOperationEnabled || state == PowerState::kQuickStopActive;
    return moving ? kQuickStopWord : kDisableVoltageWord;
  }
  switch (state) {
    case PowerState::kSwitchOnDisabled:
      return kShutdownWord;
    case PowerState::kReadyToSwitchOn:
      return kSwitchOnWord;
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      return kEnableOperationWord;
    default:
      return kDisableVoltageWord;  // a quick stop is left downwards; faults and unknown states get no power
  }
}

std::uint16_t fault_reset_word(std::uint16_t previous) noexcept {
  return has(previous, kFaultResetBit) ? kDisableVoltageWord : kFaultResetBit;
}

}  // namespace sprung::cia402
