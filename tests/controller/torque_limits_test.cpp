#include "controller/torque_limits.h"

#include <gtest/gtest.h>

#include <limits>

#include "controller/fade.h"

namespace sprung {
namespace {

ActuatorConfig actuator() {
  ActuatorConfig a;
  a.torque_limit_Nm = 100.0;
  return a;
}

JointConfig joint() {
  JointConfig j;
  j.position_min_rad = 0.0;
  j.position_max_rad = 2.0;
  return j;
}

TEST(TorqueLimiterTest, SmallTorquePassesUntouchedAndUncounted) {
  LimitCounts counts;
  TorqueLimiter limiter(actuator());
  EXPECT_EQ(limiter.limit(30.0, 0.001, counts), 30.0);
  EXPECT_EQ(counts.torque + counts.rate, 0);
}

TEST(TorqueLimiterTest, TorqueIsLimitedOnBothSides) {
  LimitCounts counts;
  TorqueLimiter limiter(actuator());
  limiter.start_from(100.0);
  EXPECT_EQ(limiter.limit(250.0, 0.001, counts), 100.0);
  limiter.start_from(-100.0);
  EXPECT_EQ(limiter.limit(-250.0, 0.001, counts), -100.0);
  EXPECT_EQ(counts.torque, 2);
  EXPECT_EQ(counts.rate, 0);
}

TEST(TorqueLimiterTest, FullTorqueTakesTwoMilliseconds) {
  LimitCounts counts;
  TorqueLimiter limiter(actuator());
  EXPECT_DOUBLE_EQ(limiter.limit(100.0, 0.001, counts), 50.0);
  EXPECT_DOUBLE_EQ(limiter.limit(100.0, 0.001, counts), 100.0);
  EXPECT_EQ(counts.rate, 1);
}

TEST(TorqueLimiterTest, StartsFromWhatIsThere) {
  LimitCounts counts;
  TorqueLimiter limiter(actuator());
  limiter.start_from(80.0);
  EXPECT_DOUBLE_EQ(limiter.limit(0.0, 0.001, counts), 30.0);
  limiter.start_from(std::numeric_limits<double>::quiet_NaN());
  EXPECT_DOUBLE_EQ(limiter.limit(10.0, 0.001, counts), 10.0);
}

TEST(SoftStopTest, PushesBackInsideTheZoneOnly) {
  LimitCounts counts;
  EXPECT_EQ(with_soft_stop(5.0, joint(), 1.0, 3.0, 500.0, 30.0, counts), 5.0);
  EXPECT_EQ(counts.soft_stop, 0);
  EXPECT_NEAR(with_soft_stop(5.0, joint(), 2.0, 0.0, 500.0, 30.0, counts), 5.0 - 500.0 * kSoftStopZone_rad,
              1e-9);
  EXPECT_NEAR(with_soft_stop(5.0, joint(), 0.0, 0.0, 500.0, 30.0, counts), 5.0 + 500.0 * kSoftStopZone_rad,
              1e-9);
  EXPECT_EQ(counts.soft_stop, 2);
}

TEST(SoftStopTest, DampsOnlyMotionIntoTheStop) {
  LimitCounts counts;
  const double still = with_soft_stop(0.0, joint(), 2.0, 0.0, 500.0, 30.0, counts);
  EXPECT_NEAR(with_soft_stop(0.0, joint(), 2.0, 2.0, 500.0, 30.0, counts), still - 60.0, 1e-9);
  EXPECT_EQ(with_soft_stop(0.0, joint(), 2.0, -2.0, 500.0, 30.0, counts), still);
}

TEST(FadeTest, FallsFromOneToZeroWithContinuousSlope) {
  Fade fade;
  EXPECT_EQ(fade.share(), 0.0);  // before the first start there is nothing to fade
  fade.start(0.02);
  EXPECT_EQ(fade.share(), 1.0);
  EXPECT_EQ(fade.rate_1_s(), 0.0);
  double before = 1.0;
  for (int k = 1; k <= 25; ++k) {
    fade.advance(0.001);
    EXPECT_LE(fade.share(), before);
    before = fade.share();
  }
  EXPECT_EQ(fade.share(), 0.0);
  EXPECT_EQ(fade.rate_1_s(), 0.0);
}

TEST(FadeTest, RateIsTheDerivativeOfTheShare) {
  Fade fade, ahead;
  fade.start(0.02);
  ahead.start(0.02);
  fade.advance(0.007);
  ahead.advance(0.007 + 1e-8);
  EXPECT_NEAR(fade.rate_1_s(), (ahead.share() - fade.share()) / 1e-8, 1e-4);
}

}  // namespace
}  // namespace sprung
