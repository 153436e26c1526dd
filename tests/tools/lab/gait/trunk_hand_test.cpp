#include "tools/lab/gait/trunk_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace sprung {
namespace {

constexpr double kTrunkHandCycle_s = 0.002;

TrunkPush named(const std::string& name) {
  for (const TrunkPush& push : trunk_pushes())
    if (name == push.name) return push;
  throw std::invalid_argument(name);
}

TEST(TrunkHandTest, PoundingIsFifteenNewtonSecondsDownWithinATenthOfASecondOrAsItsNameSays) {
  for (const auto& [name, impulse_N_s] : {std::pair{"impulse", -15.0}, std::pair{"impulse_30Ns", -30.0}}) {
    const TrunkPush push = named(name);
    TrunkHand hand(push, kTrunkHandCycle_s);
    double sum_N_s = 0.0;
    for (double t = 0.0; t < 1.0; t += kTrunkHandCycle_s) sum_N_s += kTrunkHandCycle_s * hand.step_N(t, 0.0);
    EXPECT_NEAR(sum_N_s, impulse_N_s, 0.1) << name;
    EXPECT_NEAR(push.length_s(), 0.1, 1e-12) << name;
  }
}

TEST(TrunkHandTest, NoForceBeforeWhatItIsToBeNorAfterItsLength) {
  for (const TrunkPush& push : trunk_pushes()) {
    TrunkHand hand(push, kTrunkHandCycle_s);
    EXPECT_NEAR(hand.step_N(0.0, 0.0), 0.0, 1e-9) << push.name;
    EXPECT_EQ(hand.step_N(push.length_s() + 1e-9, 0.0), 0.0) << push.name;
  }
}

TEST(TrunkHandTest, SlowForceGrowsStaysAndGoesInStraightLines) {
  TrunkHand hand(named("pushforce"), kTrunkHandCycle_s);
  EXPECT_NEAR(hand.step_N(0.5, 0.0), -75.0, 1e-9);
  EXPECT_NEAR(hand.step_N(1.5, -0.01), -150.0, 1e-9);
  EXPECT_NEAR(hand.step_N(2.75, 0.0), -37.5, 1e-9);
}

TEST(TrunkHandTest, LeadingPullsTheTrunkToWhereTheHandIs) {
  constexpr double kSpring_N_m = 2e4, kDamper_N_s_m = 8e3;
  for (const auto& [name, way_m] : {std::pair{"pushdown", -0.010}, std::pair{"pushdown_30mm", -0.030}}) {
    TrunkHand hand(named(name), kTrunkHandCycle_s);
    double trunk_m = 0.0;
    for (double t = 0.0; t < 2.0; t += kTrunkHandCycle_s)
      trunk_m += kTrunkHandCycle_s * (hand.step_N(t, trunk_m) - kSpring_N_m * trunk_m) / kDamper_N_s_m;
    EXPECT_NEAR(trunk_m, way_m / (1.0 + kSpring_N_m / TrunkHand::kStiffness_N_m), 1e-4) << name;
  }
}

}  // namespace
}  // namespace sprung
