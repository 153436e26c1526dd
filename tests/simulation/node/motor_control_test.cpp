#include "simulation/node/motor_control.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kTick_s = 0.25e-3;
constexpr double kPeriod_s = 1e-3;

TEST(PositionLoop, OnItsOwnClockASetPointThatComesEarlyOrLateChangesNoSpeed) {
  PositionLoop loop;
  loop.enter(0.0);
  double reference_counts = 0.0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    loop.set_target(100.0 * (cycle + 1), kPeriod_s);
    const int ticks = cycle % 7 == 3 ? 5 : cycle % 7 == 4 ? 3 : 4;  // one comes a tick late
    for (int i = 0; i < ticks; ++i) {
      const PositionLoop::Reference now = loop.step(kTick_s, kPeriod_s, true);
      EXPECT_NEAR(now.velocity_counts_s, 100.0 / kPeriod_s, 1e-6) << cycle;
      EXPECT_NEAR(now.position_counts - reference_counts, 25.0, 1e-9) << cycle;
      reference_counts = now.position_counts;
    }
  }
}

TEST(PositionLoop, OnItsOwnClockALostSetPointIsBridgedByTheSpeedBefore) {
  PositionLoop loop;
  loop.enter(0.0);
  for (const double target : {100.0, 200.0, 400.0}) {  // 300 is lost
    loop.set_target(target, kPeriod_s);
    for (int i = 0; i < (target == 200.0 ? 8 : 4); ++i)
      EXPECT_NEAR(loop.step(kTick_s, kPeriod_s, true).velocity_counts_s, 100.0 / kPeriod_s, 1e-6) << target;
  }
}

TEST(PositionLoop, InterpolatesAndGivesTheVelocity) {
  PositionLoop loop;
  loop.enter(100.0);
  loop.set_target(140.0);
  for (const double expected : {110.0, 120.0, 130.0, 140.0}) {
    const auto reference = loop.step(kTick_s, kPeriod_s);
    EXPECT_NEAR(reference.position_counts, expected, 1e-9);
    EXPECT_NEAR(reference.velocity_counts_s, 40000.0, 1e-6);
  }
}

TEST(PositionLoop, HoldsTheTargetWhenSetPointsStop) {
  PositionLoop loop;
  loop.enter(0.0);
  loop.set_target(40.0);
  for (int i = 0; i < 4; ++i) loop.step(kTick_s, kPeriod_s);
  const auto reference = loop.step(kTick_s, kPeriod_s);
  EXPECT_EQ(reference.position_counts, 40.0);
  EXPECT_EQ(reference.velocity_counts_s, 0.0);
}

TEST(PositionLoop, StreamOfSetPointsHasNoVelocityGap) {
  PositionLoop loop;
  loop.enter(0.0);
  for (int cycle = 1; cycle <= 50; ++cycle) {
    loop.set_target(8.0 * cycle);
    for (int i = 0; i < 4; ++i) {
      ASSERT_NEAR(loop.step(kTick_s, kPeriod_s).velocity_counts_s, 8000.0, 1e-6) << cycle << ' ' << i;
    }
  }
}

TEST(PositionLoop, EarlySetPointStartsFromWhereTheReferenceIs) {
  PositionLoop loop;
  loop.enter(0.0);
  loop.set_target(40.0);
  loop.step(kTick_s, kPeriod_s);
  loop.set_target(50.0);
  EXPECT_NEAR(loop.step(kTick_s, kPeriod_s).position_counts, 20.0, 1e-9);
}

TEST(PositionLoop, WithoutSetPointItStaysWhereItEntered) {
  PositionLoop loop;
  loop.enter(77.0);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(loop.step(kTick_s, kPeriod_s).position_counts, 77.0);
}

TEST(CurrentLoop, IsAFirstOrderLag) {
  CurrentLoop loop(94.0, kTick_s);
  for (int i = 0; i < 40; ++i) {
    const double expected = 10.0 * (1.0 - std::exp(-2 * M_PI * 94.0 * kTick_s * (i + 1)));
    ASSERT_NEAR(loop.step(10.0), expected, 1e-9);
  }
  loop.switch_off();
  EXPECT_EQ(loop.current_A(), 0.0);
}

TEST(LimitTorque, ClampsBothWaysAtRest) {
  EXPECT_EQ(limit_torque(300.0, 171.6, 0.0, 12.0), 171.6);
  EXPECT_EQ(limit_torque(-300.0, 171.6, 0.0, 12.0), -171.6);
  EXPECT_EQ(limit_torque(50.0, 171.6, 0.0, 12.0), 50.0);
}

TEST(LimitTorque, FadesInTheDirectionOfMotionOnly) {
  EXPECT_NEAR(limit_torque(100.0, 100.0, 11.4, 12.0), 50.0, 1e-9);
  EXPECT_EQ(limit_torque(-100.0, 100.0, 11.4, 12.0), -100.0);
  EXPECT_NEAR(limit_torque(-100.0, 100.0, -11.4, 12.0), -50.0, 1e-9);
  EXPECT_NEAR(limit_torque(100.0, 100.0, 12.0, 12.0), 0.0, 1e-9);
}

TEST(LimitTorque, BrakesAboveTheCap) {
  EXPECT_NEAR(limit_torque(0.0, 100.0, 12.6, 12.0), -50.0, 1e-9);
  EXPECT_EQ(limit_torque(100.0, 100.0, 20.0, 12.0), -100.0);
  EXPECT_EQ(limit_torque(-100.0, 100.0, -20.0, 12.0), 100.0);
}

TEST(LimitTorque, NoCapIsNoCap) { EXPECT_EQ(limit_torque(100.0, 100.0, 50.0, 0.0), 100.0); }

TEST(ThermalLimit, AllowsTheContinuousCurrentForever) {
  ThermalLimit limit;
  for (int i = 0; i < 100000; ++i) EXPECT_FALSE(limit.step(1.999, 2.0, 1.0, 0.001));
}

/// warmth = (current / continuous)^2 (1 - exp(-t / time constant)).
TEST(ThermalLimit, LimitsWhenWarmAndReleasesWhenCooler) {
  ThermalLimit limit;
  int ticks = 0;
  while (!limit.step(4.0, 2.0, 1.0, 0.001)) ++ticks;
  EXPECT_NEAR(ticks, 288, 2);
  ticks = 0;
  while (limit.step(0.0, 2.0, 1.0, 0.001)) ++ticks;
  EXPECT_NEAR(ticks, 51, 2);
  limit.reset();
  EXPECT_FALSE(limit.step(4.0, 2.0, 1.0, 0.001));
}

}  // namespace
}  // namespace sprung::sim
