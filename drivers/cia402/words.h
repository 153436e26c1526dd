#pragma once
/// CiA 402 power state machine: status word <-> state, control words, the way to a wanted state, mode codes.
/// Pure; used by the bridge (decode, next word) and by the simulated drives (encode, transition).
#include <cstdint>

#include "signals/modes.h"

namespace sprung::cia402 {

// Status word 0x6041 bits.
inline constexpr std::uint16_t kReadyBit = 1U << 0;
inline constexpr std::uint16_t kSwitchedOnBit = 1U << 1;
inline constexpr std::uint16_t kOperationEnabledBit = 1U << 2;
inline constexpr std::uint16_t kFaultBit = 1U << 3;
inline constexpr std::uint16_t kVoltageEnabledBit = 1U << 4;
inline constexpr std::uint16_t kQuickStopInactiveBit = 1U << 5;
inline constexpr std::uint16_t kSwitchOnDisabledBit = 1U << 6;
inline constexpr std::uint16_t kWarningBit = 1U << 7;
inline constexpr std::uint16_t kRemoteBit = 1U << 9;
inline constexpr std::uint16_t kTargetReachedBit = 1U << 10;
inline constexpr std::uint16_t kInternalLimitBit = 1U << 11;

// Control word 0x6040 commands.
inline constexpr std::uint16_t kDisableVoltageWord = 0x0000;
inline constexpr std::uint16_t kQuickStopWord = 0x0002;
inline constexpr std::uint16_t kShutdownWord = 0x0006;
inline constexpr std::uint16_t kSwitchOnWord = 0x0007;
inline constexpr std::uint16_t kEnableOperationWord = 0x000F;
inline constexpr std::uint16_t kFaultResetBit = 0x0080;  ///< acts on its rising edge

// Modes of operation 0x6060 / 0x6061.
inline constexpr std::int8_t kModeNone = 0;
inline constexpr std::int8_t kModeCyclicPosition = 8;
inline constexpr std::int8_t kModeCyclicTorque = 10;

/// By the masks 0x4F and 0x6F of CiA 402 (facts canopen 2.2); kUnknown where no state has the pattern.
PowerState decode_status(std::uint16_t status_word) noexcept;
/// State bits of the word alone (bits 0-3, 5, 6 and, where the power stage is on, 4). kUnknown gives 0.
std::uint16_t encode_status(PowerState state) noexcept;

/// What a control word does to a drive in `state`: the device's side of the state machine. Quick stop and
/// fault reaction only begin here; the device itself ends them. @param previous last control word, for the
/// fault-reset edge.
PowerState apply_control(PowerState state, std::uint16_t control_word, std::uint16_t previous) noexcept;

/// Where the master wants a drive.
enum class PowerTarget : std::int8_t {
  kOff,        ///< no voltage; a fault stays where it is
  kEnabled,    ///< operation enabled; a fault stays where it is
  kQuickStop,  ///< quick stop, and no voltage from a state that has none
};

/// Next control word on the way from `state` to `target`. Faults are left only by fault_reset_word().
std::uint16_t next_control_word(PowerState state, PowerTarget target) noexcept;

/// The bit toggles from call to call, so that an edge comes whatever was sent before. @param previous last
/// control word.
std::uint16_t fault_reset_word(std::uint16_t previous) noexcept;

}  // namespace sprung::cia402
