#include "controller/torque_limits.h"

#include <gtest/gtest.h>

#include <limits>

#include "controller/fade.h"

namespace sprung {
namespace {

ActuatorConfig torque_limits_actuator() {
  ActuatorConfig a;
  a.torque_limit_Nm = 100.0;
  a.speed_limit_rad_s = 10.0;
  a.power_limit_W = 400.0;
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
  TorqueLimiter limiter(torque_limits_actuator());
  EXPECT_EQ(limiter.limit(20.0, 0.0, 0.001, counts), 20.0);
  EXPECT_EQ(counts.torque + counts.rate, 0);
}

TEST(TorqueLimiterTest, TorqueIsLimitedOnBothSides) {
  LimitCounts counts;
  TorqueLimiter limiter(torque_limits_actuator());
  limiter.start_from(100.0);
  EXPECT_EQ(limiter.limit(250.0, 0.0, 0.001, counts), 100.0);
  limiter.start_from(-100.0);
  EXPECT_EQ(limiter.limit(-250.0, 0.0, 0.001, counts), -100.0);
  EXPECT_EQ(counts.torque, 2);
  EXPECT_EQ(counts.rate, 0);
}

TEST(TorqueLimiterTest, FullTorqueTakesFourMilliseconds) {
  LimitCounts counts;
  TorqueLimiter limiter(torque_limits_actuator());
  for (const double reached_Nm : {25.0, 50.0, 75.0, 100.0})
    EXPECT_DOUBLE_EQ(limiter.limit(100.0, 0.0, 0.001, counts), reached_Nm);
  EXPECT_EQ(counts.rate, 3);
}

TEST(TorqueLimiterTest, StartsFromWhatIsThere) {
  LimitCounts counts;
  TorqueLimiter limiter(torque_limits_actuator());
  limiter.start_from(80.0);
  EXPECT_DOUBLE_EQ(limiter.limit(0.0, 0.0, 0.001, counts), 55.0);
  limiter.start_from(std::numeric_limits<double>::quiet_NaN());
  EXPECT_DOUBLE_EQ(limiter.limit(10.0, 0.0, 0.001, counts), 10.0);
}

double settled(TorqueLimiter& limiter, double torque_Nm, double velocity_rad_s, LimitCounts& counts) {
  limiter.start_from(torque_Nm);
  for (int k = 0; k < 7; ++k) limiter.limit(torque_Nm, velocity_rad_s, 0.001, counts);
  return limiter.limit(torque_Nm, velocity_rad_s, 0.001, counts);
}

TEST(TorqueLimiterTest, NearTheSpeedLimitTorqueTowardMoreSpeedFadesAndBeyondItBrakes) {
  ActuatorConfig strong = torque_limits_actuator();
  strong.power_limit_W = 0.0;
  TorqueLimiter limiter(strong);
  LimitCounts counts;
  EXPECT_EQ(settled(limiter, 80.0, 9.0, counts), 80.0);
  EXPECT_EQ(settled(limiter, -80.0, 9.9, counts), -80.0);  // brakes
  EXPECT_EQ(counts.speed, 0);
  EXPECT_NEAR(settled(limiter, 80.0, 9.5, counts), 50.0, 1e-9);
  EXPECT_NEAR(settled(limiter, -80.0, -9.5, counts), -50.0, 1e-9);
  EXPECT_NEAR(settled(limiter, 80.0, 10.0, counts), 0.0, 1e-9);
  EXPECT_NEAR(settled(limiter, 80.0, 10.5, counts), -50.0, 1e-9);
  EXPECT_EQ(counts.speed, 32);
  EXPECT_EQ(counts.power + counts.torque, 0);
}

TEST(TorqueLimiterTest, PowerThatIsGivenIsLimitedAndBrakingIsNot) {
  TorqueLimiter limiter(torque_limits_actuator());
  LimitCounts counts;
  EXPECT_EQ(settled(limiter, 90.0, 4.0, counts), 90.0);
  EXPECT_EQ(settled(limiter, -90.0, 8.0, counts), -90.0);
  EXPECT_EQ(counts.power, 0);
  EXPECT_NEAR(settled(limiter, 90.0, 8.0, counts), 50.0, 1e-9);
  EXPECT_NEAR(settled(limiter, -90.0, -5.0, counts), -80.0, 1e-9);
  EXPECT_EQ(counts.power, 16);
  EXPECT_EQ(counts.speed, 0);
}

TEST(LimitCountsTest, AddUp) {
  LimitCounts sum{1, 2, 3, 4, 5, 6, 7};
  sum += LimitCounts{10, 20, 30, 40, 50, 60, 70};
  EXPECT_EQ(sum.soft_stop, 11);
  EXPECT_EQ(sum.power, 44);
  EXPECT_EQ(sum.velocity, 77);
  EXPECT_EQ(sum.total(), 11 * 28);
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

TEST(FadeTest, RunBeginsWithTheOldSpeedAndReturns) {
  Fade fade, ahead;
  EXPECT_EQ(fade.run_s(), 0.0);
  fade.start(0.05);
  ahead.start(0.05);
  EXPECT_EQ(fade.run_s(), 0.0);
  EXPECT_EQ(fade.run_rate(), 1.0);
  fade.advance(0.021);
  ahead.advance(0.021 + 1e-8);
  EXPECT_NEAR(fade.run_rate(), (ahead.run_s() - fade.run_s()) / 1e-8, 1e-5);
  fade.advance(1.0);
  EXPECT_EQ(fade.run_s(), 0.0);
  EXPECT_EQ(fade.run_rate(), 0.0);
}

TEST(FadeTest, TimeKeepsEveryStepBelowTheBound) {
  EXPECT_EQ(fade_time_s(0.1, 0.05, 0.001), kFade_s);
  Fade fade;
  fade.start(fade_time_s(1.5, 0.05, 0.002));
  for (double before = 1.0; before > 0.0; before = fade.share()) {
    fade.advance(0.002);
    ASSERT_LE(1.5 * (before - fade.share()), 0.05);
  }
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
