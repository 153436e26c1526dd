#include "controller/gain_ramp.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

DesiredLeg with(double stiffness_N_m, double damping_N_s_m = 0.0) {
  DesiredLeg d;
  d.stiffness_N_m = {stiffness_N_m, 0.0, 2.0 * stiffness_N_m};
  d.damping_N_s_m = {damping_N_s_m, 0.0, damping_N_s_m};
  return d;
}

DesiredLeg after(GainRamp& ramp, DesiredLeg wanted, int cycles) {
  DesiredLeg acting;
  for (int k = 0; k < cycles; ++k) {
    acting = wanted;
    ramp.advance(0.001, acting);
  }
  return acting;
}

TEST(GainRampTest, WithoutATimeGainsActAtOnce) {
  GainRamp ramp(0.0);
  ramp.start(with(100.0));
  EXPECT_EQ(after(ramp, with(2000.0, 3.0), 1).stiffness_N_m[2], 4000.0);
}

TEST(GainRampTest, BeginsWithTheGainsOfTheStart) {
  GainRamp ramp(0.05);
  ramp.start(with(2000.0, 30.0));
  const DesiredLeg acting = after(ramp, with(2000.0, 30.0), 1);
  EXPECT_EQ(acting.stiffness_N_m[0], 2000.0);
  EXPECT_EQ(acting.damping_N_s_m[2], 30.0);
}

TEST(GainRampTest, StepFromNothingAndToNothingTakesItsTimeAtEvenSpeed) {
  GainRamp ramp(0.05);
  ramp.start(with(0.0));
  EXPECT_NEAR(after(ramp, with(2000.0), 25).stiffness_N_m[0], 1000.0, 1e-9);
  EXPECT_NEAR(after(ramp, with(2000.0), 25).stiffness_N_m[0], 2000.0, 1e-9);
  EXPECT_NEAR(after(ramp, with(0.0), 25).stiffness_N_m[0], 1000.0, 1e-9);
  EXPECT_NEAR(after(ramp, with(0.0), 26).stiffness_N_m[0], 0.0, 1e-9);
}

TEST(GainRampTest, SlowScheduleIsFollowedWithoutLag) {
  GainRamp ramp(0.05);
  ramp.start(with(1000.0));
  for (int k = 1; k <= 100; ++k) {  // 1000 to 2000 in 0.1 s: half as fast as the ramp
    const double wanted = 1000.0 + 10.0 * k;
    EXPECT_EQ(after(ramp, with(wanted), 1).stiffness_N_m[0], wanted);
  }
}

TEST(GainRampTest, SharesOfFrictionInertiaAndVelocityAreRampedToo) {
  GainRamp ramp(0.1);
  ramp.start(DesiredLeg{});
  DesiredLeg wanted;
  wanted.friction_compensation = 0.8;
  wanted.inertia_compensation = 0.5;
  wanted.velocity_feedforward = 1.0;
  wanted.feedforward_force_N = {0.0, 0.0, 50.0};  // a set-point: the planner's to shape
  const DesiredLeg acting = after(ramp, wanted, 50);
  EXPECT_NEAR(acting.friction_compensation, 0.4, 1e-9);
  EXPECT_NEAR(acting.inertia_compensation, 0.25, 1e-9);
  EXPECT_NEAR(acting.velocity_feedforward, 0.5, 1e-9);
  EXPECT_EQ(acting.feedforward_force_N[2], 50.0);
}

}  // namespace
}  // namespace sprung
