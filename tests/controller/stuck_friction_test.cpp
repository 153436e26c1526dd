#include "controller/stuck_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "signals/vec3.h"

namespace sprung {
namespace {

constexpr double kStuckDt_s = 0.001;
constexpr double kStuckFriction_Nm = 7.0;
constexpr double kStuckMost = 0.35;

class StuckFrictionTest : public testing::Test {
 protected:
  void step(double velocity_rad_s, double spring_Nm, double seconds, double compensated = 0.9) {
    for (int k = 0; k < std::lround(seconds / kStuckDt_s); ++k)
      stuck_.step({velocity_rad_s, spring_Nm, kStuckFriction_Nm, compensated}, kStuckDt_s);
  }
  StuckFriction stuck_{RestFrictionConfig{10.0, 0.1, kStuckMost}};
};

TEST_F(StuckFrictionTest, GrowsWhileTheSpringPullsAndTheJointStays) {
  step(0.0, 1.5, 0.05);
  const double soon = stuck_.share();
  EXPECT_GT(soon, 0.0);
  step(0.0, 1.5, 0.05);
  EXPECT_NEAR(stuck_.share(), 2.0 * soon, 1e-9);
  step(0.0, -1.5, 5.0);
  EXPECT_DOUBLE_EQ(stuck_.share(), kStuckMost) << "and no further";
}

TEST_F(StuckFrictionTest, WhatFrictionCannotHoldIsAHandAndTeachesNothing) {
  step(0.0, (1.0 + kStuckMost - 0.9) * kStuckFriction_Nm + 0.1, 1.0);
  EXPECT_EQ(stuck_.share(), 0.0);
}

TEST_F(StuckFrictionTest, AJointThatIsWhereItIsToBeTeachesNothing) {
  step(0.0, 0.2, 1.0);
  EXPECT_EQ(stuck_.share(), 0.0);
}

TEST_F(StuckFrictionTest, MotionHomeKeepsItAndMotionAgainstTheSpringForgetsIt) {
  step(0.0, 1.5, 0.1);
  const double learnt = stuck_.share();
  step(0.5, 1.5, 0.2);
  EXPECT_EQ(stuck_.share(), learnt);
  step(-0.5, 1.5, 0.5);
  EXPECT_LT(stuck_.share(), 0.02 * learnt);
}

TEST_F(StuckFrictionTest, WithoutCompensationOrWithoutALimitThereIsNone) {
  step(0.0, 1.5, 0.1);
  step(0.0, 1.5, 0.1, 0.0);
  EXPECT_EQ(stuck_.share(), 0.0);
  stuck_ = StuckFriction(RestFrictionConfig{10.0, 0.1, 0.0});
  step(0.0, 1.5, 0.1);
  EXPECT_EQ(stuck_.share(), 0.0);
}

TEST_F(StuckFrictionTest, WhatIsNotANumberTeachesNothing) {
  step(kNaN, 1.5, 0.1);
  step(0.0, kNaN, 0.1);
  EXPECT_EQ(stuck_.share(), 0.0);
}

}  // namespace
}  // namespace sprung
