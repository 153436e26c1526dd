// References of profile modes against the textbook's trapezoid.
#include "simulation/node/profile_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kProfileTick_s = 0.00025;
constexpr ProfileLimits kProfileLimits{1000.0, 4000.0, 2000.0};

/// @return time until it rests at the target; at most 10 s.
double profile_time_to(ProfileMotion& motion, double target, double* fastest = nullptr) {
  int ticks = 0;
  while (ticks < 40000) {
    const PositionLoop::Reference now = motion.to_position(target, kProfileLimits, kProfileTick_s);
    if (fastest != nullptr) *fastest = std::max(*fastest, std::abs(now.velocity_counts_s));
    ++ticks;
    if (now.position_counts == target && now.velocity_counts_s == 0.0) break;
  }
  return ticks * kProfileTick_s;
}

TEST(ProfileMotion, LongWayTakesTheTimeOfATrapezoid) {
  for (const double sign : {1.0, -1.0}) {
    ProfileMotion motion;
    motion.enter(50.0);
    double fastest = 0.0;
    // v/a + v/d speeding up and slowing down, the rest at full speed: s - v^2/2a - v^2/2d.
    const double expected_s = 0.25 + 0.5 + (3000.0 - 125.0 - 250.0) / 1000.0;
    EXPECT_NEAR(profile_time_to(motion, 50.0 + sign * 3000.0, &fastest), expected_s, 0.01);
    EXPECT_NEAR(fastest, 1000.0, 1e-9);
  }
}

TEST(ProfileMotion, ShortWayIsATriangle) {
  ProfileMotion motion;
  motion.enter(0.0);
  double fastest = 0.0;
  // s = v^2/2a + v^2/2d
  const double peak = std::sqrt(100.0 / (1.0 / 8000.0 + 1.0 / 4000.0));
  EXPECT_NEAR(profile_time_to(motion, 100.0, &fastest), peak / 4000.0 + peak / 2000.0, 0.01);
  EXPECT_NEAR(fastest, peak, 5.0);
}

TEST(ProfileMotion, NeverOvershoots) {
  for (const double way : {0.3, 1.0, 7.0, 99.5, 1234.5}) {
    ProfileMotion motion;
    motion.enter(0.0);
    for (int i = 0; i < 20000; ++i)
      ASSERT_LE(motion.to_position(way, kProfileLimits, kProfileTick_s).position_counts, way + 1e-9) << way;
    EXPECT_EQ(motion.reference().position_counts, way);
  }
}

TEST(ProfileMotion, TargetBehindItIsReachedThroughRest) {
  ProfileMotion motion;
  motion.enter(0.0, 1000.0);
  EXPECT_NEAR(profile_time_to(motion, 0.0),
              0.5 + std::sqrt(250.0 / (1.0 / 8000.0 + 1.0 / 4000.0)) * (1.0 / 4000.0 + 1.0 / 2000.0), 0.02);
}

TEST(ProfileMotion, SpeedIsTakenUpAndGivenUpWithinItsAccelerations) {
  ProfileMotion motion;
  motion.enter(0.0);
  for (int i = 0; i < 500; ++i) motion.to_velocity(5000.0, kProfileLimits, kProfileTick_s);
  EXPECT_NEAR(motion.reference().velocity_counts_s, 500.0, 2.0) << "0.125 s at 4000";
  for (int i = 0; i < 4000; ++i) motion.to_velocity(5000.0, kProfileLimits, kProfileTick_s);
  EXPECT_EQ(motion.reference().velocity_counts_s, 1000.0) << "its limit";
  for (int i = 0; i < 1000; ++i) motion.to_velocity(0.0, kProfileLimits, kProfileTick_s);
  EXPECT_NEAR(motion.reference().velocity_counts_s, 500.0, 2.0) << "0.25 s at 2000";
}

}  // namespace
}  // namespace sprung::sim
