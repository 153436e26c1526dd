#include "tools/station/server/stick_lock.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sprung::station {
namespace {

constexpr StickInput kRest{{0.0, 0.0, 0.0}, false};
constexpr StickInput kHeldAtRest{{0.0, 0.0, 0.0}, true};
constexpr StickInput kForward{{1.0, 0.0, 0.0}, true};

TEST(StickLock, IsLockedUntilSticksAndDeadManWereSeenAtRest) {
  StickLock lock;
  lock.input(kForward, 0);
  EXPECT_EQ(lock.state(0), StickState::kLocked);
  lock.input(kHeldAtRest, 10'000);
  EXPECT_EQ(lock.state(10'000), StickState::kLocked) << "a dead-man that is tied down";
  lock.input({{0.5, 0.0, 0.0}, false}, 20'000);
  EXPECT_EQ(lock.state(20'000), StickState::kLocked) << "a stick that is pushed";
  EXPECT_NE(std::string(lock.why_locked()), "");
  lock.input(kRest, 30'000);
  EXPECT_EQ(lock.state(30'000), StickState::kReady);
  EXPECT_EQ(std::string(lock.why_locked()), "");
}

TEST(StickLock, DrivesOnlyWhileTheDeadManIsHeld) {
  StickLock lock;
  lock.input(kRest, 0);
  lock.input(kForward, 10'000);
  EXPECT_EQ(lock.state(10'000), StickState::kDriving);
  EXPECT_DOUBLE_EQ(lock.values().forward, 1.0);
  lock.input({{1.0, 0.0, 0.0}, false}, 20'000);
  EXPECT_EQ(lock.state(20'000), StickState::kReady);
  EXPECT_EQ(lock.values().forward, 0.0);
}

TEST(StickLock, StaleInputLocksAndRestMustBeSeenAgain) {
  StickLock lock;
  lock.input(kRest, 0);
  lock.input(kForward, 10'000);
  EXPECT_EQ(lock.state(10'000 + StickLock::kStale_us), StickState::kDriving);
  EXPECT_EQ(lock.state(10'001 + StickLock::kStale_us), StickState::kLocked);
  lock.input(kForward, 700'000);
  EXPECT_EQ(lock.state(700'000), StickState::kLocked);
  lock.input(kRest, 710'000);
  lock.input(kForward, 720'000);
  EXPECT_EQ(lock.state(720'000), StickState::kDriving);
}

TEST(StickLock, StaleInputLocksAlsoWhereNobodyLookedMeanwhile) {
  StickLock lock;
  lock.input(kRest, 0);
  lock.input(kForward, 10'000);
  lock.input(kForward, 1'000'000);
  EXPECT_EQ(lock.state(1'000'000), StickState::kLocked);
}

TEST(StickLock, DeadZoneIsZeroAndWhatIsBeyondBeginsThere) {
  StickLock lock;
  lock.input(kRest, 0);
  lock.input({{StickLock::kDeadZone, -0.56, -1.0}, true}, 1);
  EXPECT_EQ(lock.values().forward, 0.0);
  EXPECT_NEAR(lock.values().left, -0.5, 1e-12);
  EXPECT_DOUBLE_EQ(lock.values().turning, -1.0);
}

TEST(StickLock, WhatNoStickCanSayLocks) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1.5, -1e300}) {
    StickLock lock;
    lock.input(kRest, 0);
    lock.input({{bad, 0.0, 0.0}, true}, 1);
    EXPECT_EQ(lock.state(1), StickState::kLocked) << bad;
  }
}

}  // namespace
}  // namespace sprung::station
