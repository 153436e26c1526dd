#include "tools/station/server/estop_repeater.h"

#include <gtest/gtest.h>

namespace sprung::station {
namespace {

TEST(EstopRepeater, IsSaidAtOnceAndAgainWithin20MsUntilNoDriveHasPower) {
  EstopRepeater estop;
  EXPECT_FALSE(estop.due(0));
  EXPECT_TRUE(estop.press(1000));
  EXPECT_TRUE(estop.due(1000));
  EXPECT_FALSE(estop.due(18'999));
  EXPECT_TRUE(estop.due(19'000));
  EXPECT_FALSE(estop.drives(true, 30'000));
  EXPECT_TRUE(estop.due(41'000));
  EXPECT_TRUE(estop.drives(false, 50'000));
  EXPECT_EQ(estop.state(), EstopState::kConfirmed);
  EXPECT_EQ(estop.confirmed_us(), 50'000);
  EXPECT_FALSE(estop.due(61'000));
  EXPECT_GT(estop.next_us(), 1'000'000'000'000) << "nothing is to be said any more";
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

TEST(EstopRepeater, TellsWhenItIsToBeAskedNextAndThatIsWithin20Ms) {
  EstopRepeater estop;
  EXPECT_GT(estop.next_us(), 1'000'000'000'000);
  estop.press(1000);
  EXPECT_EQ(estop.next_us(), 1000);
  ASSERT_TRUE(estop.due(1500));
  EXPECT_GT(estop.next_us(), 1500);
  EXPECT_LT(estop.next_us(), 1500 + 20'000);
}

}  // namespace
}  // namespace sprung::station
