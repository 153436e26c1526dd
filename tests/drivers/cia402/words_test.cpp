#include "drivers/cia402/words.h"

#include <gtest/gtest.h>

namespace sprung::cia402 {
namespace {

constexpr PowerState kCia402WordsStates[] = {
    PowerState::kNotReadyToSwitchOn,  PowerState::kSwitchOnDisabled,
    PowerState::kReadyToSwitchOn,     PowerState::kSwitchedOn,
    PowerState::kOperationEnabled,    PowerState::kQuickStopActive,
    PowerState::kFaultReactionActive, PowerState::kFault,
};

TEST(StatusWord, EveryStateSurvivesEncodingWithForeignBitsSet) {
  for (const PowerState state : kCia402WordsStates) {
    EXPECT_EQ(decode_status(encode_status(state)), state) << name(state);
    const auto noisy = static_cast<std::uint16_t>(encode_status(state) | kRemoteBit | kWarningBit | 0x4000);
    EXPECT_EQ(decode_status(noisy), state) << name(state);
  }
}

// The twelve words of a real EPOS2 (facts canopen 2.2).
TEST(StatusWord, DecodesTheWordsOfRealDrives) {
  EXPECT_EQ(decode_status(0x0140), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(decode_status(0x0121), PowerState::kReadyToSwitchOn);
  EXPECT_EQ(decode_status(0x4123), PowerState::kSwitchedOn);
  EXPECT_EQ(decode_status(0x4133), PowerState::kSwitchedOn);
  EXPECT_EQ(decode_status(0x0137), PowerState::kOperationEnabled);
  EXPECT_EQ(decode_status(0x0117), PowerState::kQuickStopActive);
  EXPECT_EQ(decode_status(0x011F), PowerState::kFaultReactionActive);
  EXPECT_EQ(decode_status(0x0108), PowerState::kFault);
  EXPECT_EQ(decode_status(0x0002), PowerState::kUnknown);
}

/// Drive and master in turns until nothing moves; the state where they end.
PowerState settle(PowerState state, PowerTarget target) {
  std::uint16_t previous = 0;
  for (int i = 0; i < 10; ++i) {
    const std::uint16_t word = next_control_word(state, target);
    state = apply_control(state, word, previous);
    previous = word;
  }
  return state;
}

TEST(Enabling, WalksToOperationEnabledFromEveryStateWithoutFault) {
  for (const PowerState state :
       {PowerState::kSwitchOnDisabled, PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn,
        PowerState::kOperationEnabled, PowerState::kQuickStopActive}) {
    EXPECT_EQ(settle(state, PowerTarget::kEnabled), PowerState::kOperationEnabled) << name(state);
  }
}

TEST(Enabling, NeverLeavesAFaultByItself) {
  for (const PowerTarget target : {PowerTarget::kEnabled, PowerTarget::kOff, PowerTarget::kQuickStop}) {
    EXPECT_EQ(settle(PowerState::kFault, target), PowerState::kFault);
    EXPECT_EQ(settle(PowerState::kFaultReactionActive, target), PowerState::kFaultReactionActive);
  }
}

TEST(SwitchingOff, TakesOneWordFromEveryPoweredState) {
  for (const PowerState state : {PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn,
                                 PowerState::kOperationEnabled, PowerState::kQuickStopActive}) {
    EXPECT_EQ(apply_control(state, next_control_word(state, PowerTarget::kOff), 0),
              PowerState::kSwitchOnDisabled);
  }
}

TEST(QuickStop, BeginsOnlyWhereThereIsTorque) {
  const auto after = [](PowerState state) {
    return apply_control(state, next_control_word(state, PowerTarget::kQuickStop), 0);
  };
  EXPECT_EQ(after(PowerState::kOperationEnabled), PowerState::kQuickStopActive);
  EXPECT_EQ(after(PowerState::kQuickStopActive), PowerState::kQuickStopActive);
  EXPECT_EQ(after(PowerState::kSwitchedOn), PowerState::kSwitchOnDisabled);
}

TEST(FaultReset, NeedsARisingEdge) {
  EXPECT_EQ(apply_control(PowerState::kFault, kFaultResetBit, kFaultResetBit), PowerState::kFault);
  EXPECT_EQ(apply_control(PowerState::kFault, kFaultResetBit, 0), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(fault_reset_word(kDisableVoltageWord), kFaultResetBit);
  EXPECT_EQ(fault_reset_word(kFaultResetBit), kDisableVoltageWord);
}

TEST(FaultReset, WordCarriesNoOtherCommand) {
  const auto word = static_cast<std::uint16_t>(kFaultResetBit | kEnableOperationWord);
  EXPECT_EQ(apply_control(PowerState::kSwitchedOn, word, 0), PowerState::kSwitchedOn);
}

}  // namespace
}  // namespace sprung::cia402
