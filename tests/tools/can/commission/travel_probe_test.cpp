#include "tools/can/commission/travel_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sprung::commission {
namespace {

constexpr double kDt_s = 0.005, kInertia_kg_m2 = 0.8, kFriction_Nm = 7.0;

/// A mass with dry friction, whose torque may be a share of what is asked for.
struct Joint {
  double position_rad = 1.0, speed_rad_s = 0.0, highest_Nm = 0.0;

  template <class Share>
  void step(double asked_Nm, Share share) {
    highest_Nm = std::max(highest_Nm, std::abs(asked_Nm));
    constexpr int kSubsteps = 50;
    for (int i = 0; i < kSubsteps; ++i) {
      const double torque_Nm = asked_Nm * share(position_rad);
      const double dt_s = kDt_s / kSubsteps;
      const double free_rad_s = speed_rad_s + torque_Nm / kInertia_kg_m2 * dt_s;
      const double friction_rad_s = kFriction_Nm / kInertia_kg_m2 * dt_s;
      speed_rad_s = std::copysign(std::max(0.0, std::abs(free_rad_s) - friction_rad_s), free_rad_s);
      position_rad += speed_rad_s * dt_s;
    }
  }
};

TravelPlan plan(double direction) {
  TravelPlan out;
  out.direction = direction;
  out.cap_Nm = 1.4 * kFriction_Nm;
  out.inertia_kg_m2 = kInertia_kg_m2;
  return out;
}

template <class Share>
TravelProbe run(Joint& joint, double direction, Share share) {
  TravelProbe probe(plan(direction));
  for (int i = 0; i < 4000 && probe.outcome() == Travel::kGoing; ++i)
    joint.step(probe.step(kDt_s, joint.position_rad), share);
  return probe;
}

TEST(TravelProbe, ARightDriveArrivesBothWaysWithLittleMoreThanFriction) {
  for (const double direction : {1.0, -1.0}) {
    Joint joint;
    const TravelProbe probe = run(joint, direction, [](double) { return 1.0; });
    EXPECT_EQ(probe.outcome(), Travel::kArrived);
    EXPECT_NEAR(direction * (joint.position_rad - 1.0), 0.03, 0.003);
    EXPECT_NEAR(probe.breakaway_Nm(), kFriction_Nm, 1.0);
    EXPECT_NEAR(direction * probe.sliding_Nm(), kFriction_Nm, 0.5);
    EXPECT_LT(joint.highest_Nm, 1.2 * kFriction_Nm);
  }
}

TEST(TravelProbe, ATorqueOfTheWrongSignIsStoppedAtOnce) {
  Joint joint;
  const TravelProbe probe = run(joint, 1.0, [](double) { return -1.0; });
  EXPECT_EQ(probe.outcome(), Travel::kWrongWay);
  EXPECT_LT(std::abs(joint.position_rad - 1.0), 0.01);
}

TEST(TravelProbe, ALockedRotorNeverGetsMoreThanTheCap) {
  Joint joint;
  const TravelProbe probe = run(joint, 1.0, [](double) { return 0.3; });
  EXPECT_EQ(probe.outcome(), Travel::kNoMotion);
  EXPECT_LE(joint.highest_Nm, 1.4 * kFriction_Nm);
  EXPECT_EQ(joint.position_rad, 1.0);
}

TEST(TravelProbe, ATorqueThatFadesWithTheAngleIsTold) {
  Joint joint;  // one pole pair too few, ratio 100
  const TravelProbe probe = run(joint, 1.0, [](double rad) { return std::cos(100.0 * (rad - 1.0)); });
  EXPECT_EQ(probe.outcome(), Travel::kFades);
  EXPECT_LT(joint.position_rad - 1.0, 0.03);
}

TEST(TravelProbe, ARunawayIsStoppedBeforeTheBound) {
  TravelProbe probe(plan(1.0));
  EXPECT_GE(probe.step(kDt_s, 1.0), 0.0);
  EXPECT_EQ(probe.step(kDt_s, 1.05), 0.0);
  EXPECT_EQ(probe.outcome(), Travel::kTooFar);
  TravelProbe fast(plan(1.0));
  double position_rad = 0.0;
  for (int i = 0; i < 5 && fast.outcome() == Travel::kGoing; ++i) fast.step(kDt_s, position_rad += 0.008);
  EXPECT_EQ(fast.outcome(), Travel::kTooFast);
  EXPECT_EQ(fast.step(kDt_s, position_rad), 0.0) << "it stays off";
}

}  // namespace
}  // namespace sprung::commission
