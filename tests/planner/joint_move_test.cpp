#include "planner/joint_move.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

TEST(JointMoveTest, LongWayHasTheSpeedInItsMiddle) {
  const JointMove move(0.5, 2.5, 0.8, 2.0);
  EXPECT_NEAR(move.duration_s(), 2.0 / 0.8 + 0.8 / 2.0, 1e-12);
  EXPECT_NEAR(move.at(0.2).velocity_rad_s, 0.4, 1e-12);
  EXPECT_NEAR(move.at(0.4).position_rad, 0.5 + 0.16, 1e-12);
  EXPECT_NEAR(move.at(1.0).velocity_rad_s, 0.8, 1e-12);
  EXPECT_NEAR(move.at(move.duration_s() - 0.2).velocity_rad_s, 0.4, 1e-12);
}

TEST(JointMoveTest, ShortWayNeverReachesTheSpeed) {
  const JointMove move(1.0, 0.92, 5.0, 2.0);
  EXPECT_NEAR(move.duration_s(), 2.0 * std::sqrt(0.08 / 2.0), 1e-12);
  EXPECT_NEAR(move.at(move.duration_s() / 2).velocity_rad_s, -std::sqrt(0.08 * 2.0), 1e-12);
}

TEST(JointMoveTest, RestsAtItsEndsOutside) {
  const JointMove move(0.1, 0.4, 1.0, 1.0);
  EXPECT_EQ(move.at(-1.0).position_rad, 0.1);
  EXPECT_EQ(move.at(-1.0).velocity_rad_s, 0.0);
  EXPECT_EQ(move.at(100.0).position_rad, 0.4);
  EXPECT_EQ(move.at(100.0).velocity_rad_s, 0.0);
  const JointMove nowhere(0.3, 0.3, 1.0, 1.0);
  EXPECT_EQ(nowhere.duration_s(), 0.0);
  EXPECT_EQ(nowhere.at(0.0).position_rad, 0.3);
}

TEST(JointMoveTest, StaysBetweenItsEndsAndWithinSpeedAndAcceleration) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3.0, 3.0), rate(0.01, 20.0);
  constexpr double kStep_s = 1e-3;
  for (int n = 0; n < 200; ++n) {
    const double from = angle(random), to = angle(random), speed = rate(random), acceleration = rate(random);
    const JointMove move(from, to, speed, acceleration);
    JointPoint before = move.at(0.0);
    for (double t = 0.0; t < move.duration_s() + 0.01; t += kStep_s) {
      const JointPoint now = move.at(t);
      ASSERT_GE(now.position_rad, std::min(from, to) - 1e-12);
      ASSERT_LE(now.position_rad, std::max(from, to) + 1e-12);
      ASSERT_LE(std::abs(now.velocity_rad_s), speed * (1.0 + 1e-12));
      ASSERT_LE(std::abs(now.velocity_rad_s - before.velocity_rad_s), acceleration * kStep_s + 1e-9);
      ASSERT_NEAR(now.position_rad, before.position_rad,
                  std::abs(now.velocity_rad_s + before.velocity_rad_s) / 2 * kStep_s +
                      acceleration * kStep_s * kStep_s);
      before = now;
    }
  }
}

TEST(JointMoveTest, BrakingGoesOnFromWhereItIsAndNeverBackOrFurther) {
  const JointMove move(2.0, 0.0, 1.0, 4.0);
  for (const double at_s : {0.1, 0.25, 1.0, move.duration_s() - 0.1}) {
    const JointMove braked = move.braked(at_s);
    const JointPoint now = move.at(at_s);
    EXPECT_NEAR(braked.at(0.0).position_rad, now.position_rad, 1e-12);
    EXPECT_NEAR(braked.at(0.0).velocity_rad_s, now.velocity_rad_s, 1e-12);
    EXPECT_NEAR(braked.duration_s(), std::abs(now.velocity_rad_s) / 4.0, 1e-12);
    EXPECT_LT(braked.end_rad(), now.position_rad);
    EXPECT_GE(braked.end_rad(), -1e-12);
    EXPECT_NEAR(braked.at(braked.duration_s() / 2).velocity_rad_s, now.velocity_rad_s / 2, 1e-12);
  }
  EXPECT_EQ(move.braked(100.0).duration_s(), 0.0);
}

}  // namespace
}  // namespace sprung
