// The small parts of the bridge: power control, position tracker, sentences.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drivers/bridge/detail_text.h"
#include "drivers/bridge/position_tracker.h"
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

TEST(PositionTracker, VelocitySettlesOnASteadyMotion) {
  PositionTracker tracker(12.0);
  double position = 0.5;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(tracker.add(position, 1000 * i));
    position += 0.003;
  }
  EXPECT_NEAR(tracker.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST(PositionTracker, MissedSamplesDoNotDoubleTheVelocity) {
  PositionTracker tracker(12.0);
  for (int i = 0; i < 300; ++i) {
    if (i % 3 != 1) tracker.add(0.003 * i, 1000 * i);
  }
  EXPECT_NEAR(tracker.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST(PositionTracker, FirstSampleIsNoMotionAndAJumpIsImplausible) {
  PositionTracker tracker(12.0);
  EXPECT_TRUE(tracker.add(100.0, 0));
  EXPECT_EQ(tracker.filtered_velocity_rad_s(), 0.0);
  EXPECT_TRUE(tracker.add(100.3, 1000));
  EXPECT_FALSE(tracker.add(100.9, 2000));
  tracker.reset();
  EXPECT_TRUE(tracker.add(-50.0, 3000));
}

TEST(PositionTracker, ImplausibleStepDoesNotTouchTheVelocity) {
  PositionTracker tracker(12.0);
  for (int i = 0; i < 100; ++i) tracker.add(0.003 * i, 1000 * i);
  const double before_rad_s = tracker.filtered_velocity_rad_s();
  EXPECT_FALSE(tracker.add(50.0, 100'000));
  EXPECT_EQ(tracker.filtered_velocity_rad_s(), before_rad_s);
  EXPECT_TRUE(tracker.add(50.003, 101'000)) << "goes on from where it is now";
  EXPECT_NEAR(tracker.filtered_velocity_rad_s(), 3.0, 1e-6);
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
