#include "tools/station/server/estop_repeater.h"

#include <gtest/gtest.h>

namespace sprung::station {
namespace {

TEST(EstopRepeater, IsSaidAtOnceAndEvery20MsUntilNoDriveHasPower) {
  EstopRepeater estop;
  EXPECT_FALSE(estop.due(0));
  EXPECT_TRUE(estop.press(1000));
  EXPECT_TRUE(estop.due(1000));
  EXPECT_FALSE(estop.due(20'999));
  EXPECT_TRUE(estop.due(21'000));
  EXPECT_FALSE(estop.drives(true, 30'000));
  EXPECT_TRUE(estop.due(41'000));
  EXPECT_TRUE(estop.drives(false, 50'000));
  EXPECT_EQ(estop.state(), EstopState::kConfirmed);
  EXPECT_EQ(estop.confirmed_us(), 50'000);
  EXPECT_FALSE(estop.due(61'000));
}

TEST(EstopRepeater, WhatWasMeasuredBeforeThePressConfirmsNothing) {
  EstopRepeater estop;
  estop.press(1000);
  EXPECT_FALSE(estop.drives(false, 1000));
  EXPECT_EQ(estop.state(), EstopState::kPressed);
}

TEST(EstopRepeater, PressedAgainWhilePressedChangesNothingAndAfterwardsBeginsAnew) {
  EstopRepeater estop;
  estop.press(1000);
  EXPECT_FALSE(estop.press(2000));
  EXPECT_EQ(estop.pressed_us(), 1000);
  estop.drives(false, 3000);
  EXPECT_TRUE(estop.press(4000)) << "somebody may have said clear and stand meanwhile";
  EXPECT_TRUE(estop.due(4000));
}

}  // namespace
}  // namespace sprung::station
