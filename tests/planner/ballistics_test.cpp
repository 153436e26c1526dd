#include "planner/ballistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

TEST(Ballistics, PapersHeightFollowsFromItsOwnFlight) {
  // Facts C1: 188 mm need 392 ms where the leg is as long at touchdown as at lift-off.
  EXPECT_NEAR(rise_m(0.5, 0.5, 0.392), 0.188, 0.001);
}

TEST(Ballistics, RiseUndoesAFlightOfAnyLengths) {
  for (const double speed_m_s : {0.8, 1.5, 2.2}) {
    for (const double touchdown_m : {0.40, 0.478, 0.55}) {
      const ExpectedTouchdown expected = expected_touchdown({1000, 0.55, speed_m_s}, touchdown_m);
      const double flight_s = 1e-6 * static_cast<double>(expected.utime_us - 1000);
      EXPECT_NEAR(0.55 + speed_m_s * flight_s - 0.5 * kGravity_m_s2 * flight_s * flight_s, touchdown_m, 1e-5);
      EXPECT_NEAR(expected.approach_speed_m_s, kGravity_m_s2 * flight_s - speed_m_s, 1e-4);
      EXPECT_NEAR(rise_m(0.55, touchdown_m, flight_s), speed_m_s * speed_m_s / (2.0 * kGravity_m_s2), 1e-5);
    }
  }
}

TEST(Ballistics, ShorterLegAtTouchdownMeansALowerJump) {
  EXPECT_LT(rise_m(0.55, 0.45, 0.39), rise_m(0.55, 0.55, 0.39));
  EXPECT_EQ(rise_m(0.55, 0.30, 0.10), 0.0);  // it only fell
}

TEST(Ballistics, HipThatDoesNotRiseThatFarIsExpectedAtTheTop) {
  const ExpectedTouchdown expected = expected_touchdown({0, 0.40, 0.981}, 0.55);
  EXPECT_EQ(expected.utime_us, 100000);
  EXPECT_EQ(expected.approach_speed_m_s, 0.0);
}

TEST(Ballistics, RiseFromTheSurfaceIsLessOnGroundThatThrowsTheHipUp) {
  EXPECT_EQ(rise_from_surface_m(0.15, kFirmShare), 0.15);
  EXPECT_NEAR(rise_from_surface_m(0.15, kFirmShare + 0.1), 0.15 * 0.94, 1e-12);
  EXPECT_NEAR(rise_from_surface_m(0.15, 9.0), 0.15 * 0.8, 1e-12);  // whatever was measured
  EXPECT_NEAR(rise_from_surface_m(0.15, 0.0), 0.15 * 1.2, 1e-12);
}

TEST(Ballistics, FallFromRestGainsSpeedWithTime) {
  const ExpectedTouchdown expected = fall_from_rest(5000, 0.25);
  EXPECT_EQ(expected.utime_us, 255000);
  EXPECT_NEAR(expected.approach_speed_m_s, 2.4525, 1e-12);
}

}  // namespace
}  // namespace sprung
