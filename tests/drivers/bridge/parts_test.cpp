// The small parts of the bridge: power control, sentences.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drivers/bridge/detail_text.h"
#include "drivers/bridge/power_control.h"
#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

using cia402::PowerTarget;

TEST(PowerControl, SendsOnChangeAndAtTenHertz) {
  PowerControl power;
  std::uint16_t word = 1;
  EXPECT_TRUE(power.step(PowerState::kSwitchOnDisabled, 0, word));
  EXPECT_EQ(word, cia402::kDisableVoltageWord);
  EXPECT_FALSE(power.step(PowerState::kSwitchOnDisabled, 99'999, word));
  EXPECT_TRUE(power.step(PowerState::kSwitchOnDisabled, 100'000, word));
  power.set_target(PowerTarget::kEnabled, 101'000);
  EXPECT_TRUE(power.step(PowerState::kSwitchOnDisabled, 101'000, word));
  EXPECT_EQ(word, cia402::kShutdownWord);
}

TEST(PowerControl, WordThatMayBeLostIsSentOnceMore) {
  PowerControl power;
  std::uint16_t word = 1;
  ASSERT_TRUE(power.step(PowerState::kSwitchOnDisabled, 0, word));
  power.resend();
  EXPECT_TRUE(power.step(PowerState::kSwitchOnDisabled, 1000, word));
  EXPECT_EQ(word, cia402::kDisableVoltageWord);
  EXPECT_FALSE(power.step(PowerState::kSwitchOnDisabled, 2000, word));
}

TEST(PowerControl, QuickStopEndsWithoutVoltageAfterHalfASecond) {
  PowerControl power;
  std::uint16_t word = 0;
  power.set_target(PowerTarget::kQuickStop, 1000);
  power.step(PowerState::kOperationEnabled, 1000, word);
  EXPECT_EQ(word, cia402::kQuickStopWord);
  power.set_target(PowerTarget::kQuickStop, 400'000);
  power.step(PowerState::kQuickStopActive, 500'999, word);
  EXPECT_EQ(word, cia402::kQuickStopWord);
  power.step(PowerState::kQuickStopActive, 501'000, word);
  EXPECT_EQ(word, cia402::kDisableVoltageWord);
}

TEST(PowerControl, FaultGetsEdgesOnlyWhenAskedTo) {
  PowerControl power;
  std::uint16_t word = 0;
  power.set_target(PowerTarget::kEnabled, 0);
  power.step(PowerState::kFault, 0, word);
  EXPECT_EQ(word, cia402::kDisableVoltageWord);
  power.reset_faults(true);
  power.step(PowerState::kFault, 20'000, word);
  EXPECT_EQ(word, cia402::kFaultResetBit);
  power.step(PowerState::kFault, 21'000, word);
  EXPECT_EQ(word, cia402::kFaultResetBit) << "long enough to be seen";
  power.step(PowerState::kFault, 40'000, word);
  EXPECT_EQ(word, cia402::kDisableVoltageWord) << "down again, for another edge";
  power.step(PowerState::kSwitchOnDisabled, 41'000, word);
  EXPECT_EQ(word, cia402::kShutdownWord);
}

TEST(DetailText, DifferencesShowQuantitiesInDecimalAndIdentitiesInHexadecimal) {
  DetailText text{};
  print_difference(text, "hip", {{canopen::kMaxTorque, 0}, 2, 5571, false}, 5000);
  EXPECT_STREQ(text.data(), "hip: object 0x6072:00 max torque: expected 5571, found 5000");
  print_difference(text, "hip", {{canopen::kInterpolationPeriod, 2}, 1, 0xFD, true}, 0xFE);
  EXPECT_STREQ(text.data(), "hip: object 0x60C2:02 interpolation period: expected -3, found -2");
  print_difference(text, "hip", {{0x1800, 1}, 4, 0x40000181, false}, 0xC0000181);
  EXPECT_STREQ(text.data(),
               "hip: object 0x1800:01 transmit PDO settings: expected 0x40000181, found 0xC0000181");
}

TEST(DetailText, LongSentencesAreCutNotOverrun) {
  DetailText text{};
  const std::string longer(500, 'x');
  print(text, "%s", longer.c_str());
  EXPECT_EQ(std::string(text.data()), longer.substr(0, 159));
}

}  // namespace
}  // namespace sprung
