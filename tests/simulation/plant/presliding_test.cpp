#include "simulation/plant/presliding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kFull_Nm = 8.0;
constexpr double kPreslidingWay_rad = 0.4e-3;
constexpr double kMass_kg_m2 = 0.81;
constexpr double kStep_s = 0.25e-3;

Presliding fresh() { return {kFull_Nm, kPreslidingWay_rad, kMass_kg_m2}; }

/// In small steps, at rest between them.
double after(Presliding& friction, double way_rad) {
  for (int i = 0; i < 1000; ++i) friction.move(way_rad / 1000, kFull_Nm);
  return friction.torque_Nm(0.0);
}

TEST(Presliding, ReachesAllOfItAfterItsWayAndNotBefore) {
  Presliding friction = fresh();
  EXPECT_EQ(friction.torque_Nm(0.0), 0.0);
  EXPECT_LT(after(friction, 0.98 * kPreslidingWay_rad), 0.999 * kFull_Nm);
  EXPECT_NEAR(after(friction, 0.03 * kPreslidingWay_rad), kFull_Nm, 1e-12);
  EXPECT_NEAR(after(friction, 1.0), kFull_Nm, 1e-12) << "and slides with no more than that";
}

/// Each spring by hand: a quarter of the torque, from where it slides; half the way strains the last by half.
TEST(Presliding, CurveIsTheSumOfFourSprings) {
  Presliding friction = fresh();
  EXPECT_NEAR(friction.stiffness_Nm_rad(), 4.25 * kFull_Nm / kPreslidingWay_rad, 1e-9);
  EXPECT_NEAR(after(friction, 0.1 * kPreslidingWay_rad), kFull_Nm / 4 * (1.0 + 0.4 + 0.2 + 0.1), 1e-9);
  EXPECT_NEAR(after(friction, 0.4 * kPreslidingWay_rad), kFull_Nm / 4 * (1.0 + 1.0 + 1.0 + 0.5), 1e-9);
}

/// Masing's rule: after a reversal the same curve, twice as wide and twice as high.
TEST(Presliding, ReversalFollowsTheSameCurveTwiceAsWide) {
  Presliding first = fresh();
  Presliding back = fresh();
  after(back, 3 * kPreslidingWay_rad);
  for (const double share : {0.05, 0.1, 0.2, 0.3}) {
    const double virgin_Nm = after(first, share * kPreslidingWay_rad);
    EXPECT_NEAR(kFull_Nm - after(back, -2 * share * kPreslidingWay_rad), 2 * virgin_Nm, 1e-9) << share;
  }
}

TEST(Presliding, LoopInsideALoopClosesAndCreepsNowhere) {
  Presliding friction = fresh();
  const double before_Nm = after(friction, 0.6 * kPreslidingWay_rad);
  double lost_J = 0.0;
  for (int loop = 0; loop < 100; ++loop) {
    const double out_Nm = after(friction, -0.3 * kPreslidingWay_rad);
    lost_J += 0.15 * kPreslidingWay_rad * (before_Nm - out_Nm);
    ASSERT_NEAR(after(friction, 0.3 * kPreslidingWay_rad), before_Nm, 1e-9) << loop;
  }
  EXPECT_GT(lost_J, 0.0);
}

TEST(Presliding, TakesEnergyInEveryLoop) {
  Presliding friction = fresh();
  double work_J = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double way_rad = 1e-6 * std::cos(2 * M_PI * i / 2000.0);
    const double before_Nm = friction.torque_Nm(0.0);
    friction.move(way_rad, kFull_Nm);
    work_J += 0.5 * (before_Nm + friction.torque_Nm(0.0)) * way_rad;
  }
  EXPECT_GT(work_J, 1e-3);
}

/// A mass pushed with 90 % of what breaks it loose comes to rest on the curve and stays there.
TEST(Presliding, HoldsAMassUnderNinetyPercent) {
  Presliding friction = fresh();
  double position_rad = 0.0, speed_rad_s = 0.0, at_2_s_rad = 0.0;
  for (int i = 0; i < 48000; ++i) {
    const double pushed_Nm = 0.9 * kFull_Nm * std::min(1.0, i / 400.0);
    speed_rad_s += kStep_s / kMass_kg_m2 * (pushed_Nm - friction.torque_Nm(speed_rad_s));
    position_rad += kStep_s * speed_rad_s;
    friction.move(kStep_s * speed_rad_s, kFull_Nm);
    if (i == 8000) at_2_s_rad = position_rad;
  }
  EXPECT_LT(position_rad, kPreslidingWay_rad);
  EXPECT_NEAR(position_rad, at_2_s_rad, 1e-9) << "10 s later";
  EXPECT_NEAR(friction.torque_Nm(0.0), 0.9 * kFull_Nm, 1e-6);
}

TEST(Presliding, TakesWhatDryFrictionIsNowAndKeepsAStrainThatItCanHold) {
  Presliding friction = fresh();
  after(friction, 2 * kPreslidingWay_rad);
  friction.move(0.0, 0.5 * kFull_Nm);
  EXPECT_NEAR(friction.torque_Nm(0.0), 0.5 * kFull_Nm, 1e-12) << "what slides follows at once";
  friction.move(0.0, 2 * kFull_Nm);
  EXPECT_NEAR(friction.torque_Nm(0.0), 0.5 * kFull_Nm, 1e-12) << "no torque without a way";
  friction.reset();
  EXPECT_EQ(friction.torque_Nm(0.0), 0.0);
}

TEST(Presliding, DampsWhatHoldsAndNotWhatSlides) {
  Presliding friction = fresh();
  EXPECT_GT(friction.torque_Nm(0.1), 0.0);
  EXPECT_LT(friction.torque_Nm(0.1), 0.5 * kFull_Nm);
  after(friction, 2 * kPreslidingWay_rad);
  EXPECT_NEAR(friction.torque_Nm(5.0), kFull_Nm, 1e-12);
}

}  // namespace
}  // namespace sprung::sim
