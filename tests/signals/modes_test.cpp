#include "signals/modes.h"

#include <gtest/gtest.h>

#include "tests/support/every_enumeration.h"

namespace sprung {
namespace {

TEST(Modes, EveryValueHasItsOwnName) {
  test::of_every_enumeration([](auto value) { test::expect_own_names<decltype(value)>(); });
}

TEST(Modes, EveryLegEventHasItsCounter) {
  EXPECT_EQ(kLegEventCount, static_cast<std::size_t>(LegEvent::kStumble) + 1);
}

TEST(Modes, WalkingsValuesOnTheWireStayWhatTheyAre) {
  EXPECT_EQ(static_cast<int>(LegPhase::kSwing), 7);
  EXPECT_EQ(static_cast<int>(LegPhase::kStance), 9);
  EXPECT_EQ(static_cast<int>(MotionPhase::kWalking), 11);
  EXPECT_EQ(static_cast<int>(MotionPhase::kFallen), 12);
  EXPECT_EQ(static_cast<int>(OperatorKind::kWalk), 11);
  EXPECT_EQ(static_cast<int>(GaitControl::kForce), 0);
  EXPECT_EQ(static_cast<int>(GaitControl::kAdaptive), 3);
}

TEST(Modes, ValueOffTheWireThatIsUnknownStillHasAName) {
  EXPECT_STREQ(name(static_cast<DriveMode>(99)), "unknown");
  EXPECT_STREQ(name(static_cast<SafetyCause>(-1)), "unknown");
  EXPECT_STREQ(name(static_cast<LegEvent>(6)), "unknown");
  EXPECT_STREQ(name(static_cast<GaitControl>(4)), "unknown");
  EXPECT_STREQ(name(static_cast<MotionPhase>(13)), "unknown");
}

}  // namespace
}  // namespace sprung
