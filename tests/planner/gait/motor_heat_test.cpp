#include "planner/gait/motor_heat.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

JointState motors_at(double one, double others) {
  JointState state(12, 4);
  for (EstimatedJoint& joint : state.joints) joint.winding_share = others;
  state.joints[5].winding_share = one;
  return state;
}

TEST(MotorHeatTest, WarmMotorsSlowTheWalkBeforeTheyEndIt) {
  MotorHeat heat;
  heat.begin(motors_at(0.1, 0.1));
  EXPECT_EQ(heat.speed_share(), 1.0);
  double before = 1.0;
  for (double warmth = 0.5; warmth < MotorHeat::kStands; warmth += 0.01) {
    heat.step(motors_at(warmth, 0.1));
    EXPECT_LE(heat.speed_share(), before);
    EXPECT_FALSE(heat.too_warm()) << warmth;
    before = heat.speed_share();
  }
  EXPECT_LT(before, 0.4);
  heat.step(motors_at(MotorHeat::kStands, 0.1));
  EXPECT_TRUE(heat.too_warm());
}

TEST(MotorHeatTest, BeginsOnlyWithMotorsThatHaveCooled) {
  MotorHeat heat;
  heat.begin(motors_at(MotorHeat::kSlowFrom + 0.01, 0.1));
  EXPECT_TRUE(heat.too_warm());
  heat.begin(motors_at(MotorHeat::kSlowFrom - 0.01, 0.1));
  EXPECT_FALSE(heat.too_warm());
}

TEST(MotorHeatTest, MotorsOfWhichNothingIsKnownAreCold) {
  MotorHeat heat;
  heat.begin(motors_at(kNaN, kNaN));
  EXPECT_EQ(heat.speed_share(), 1.0);
  EXPECT_FALSE(heat.too_warm());
  heat.step(motors_at(0.95, kNaN));
  EXPECT_TRUE(heat.too_warm());
}

}  // namespace
}  // namespace sprung
