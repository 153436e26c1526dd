#include "planner/foot_move.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

const FootMove kMove{{0.1, 0.0, -0.3}, {0.0, 0.0, -0.45}, 0.8};

TEST(FootMoveTest, RestsAtBothEnds) {
  for (double t : {-1.0, 0.0, 0.8, 2.0}) {
    const FootPoint p = kMove.at(t);
    EXPECT_EQ(p.position_m, t > 0.4 ? kMove.to_m : kMove.from_m);
    EXPECT_EQ(p.velocity_m_s, (Vec3{0.0, 0.0, 0.0}));
    EXPECT_EQ(p.acceleration_m_s2, (Vec3{0.0, 0.0, 0.0}));
  }
}

TEST(FootMoveTest, IsHalfWayAtHalfTimeWithTheKnownPeakSpeed) {
  const FootPoint p = kMove.at(0.4);
  EXPECT_NEAR(p.position_m[2], -0.375, 1e-15);
  EXPECT_NEAR(p.velocity_m_s[2], -1.875 * 0.15 / 0.8, 1e-12);  // 15/8 of the mean
  EXPECT_NEAR(p.acceleration_m_s2[2], 0.0, 1e-12);
}

TEST(FootMoveTest, DerivativesBelongToThePath) {
  constexpr double kStep = 1e-6;
  for (double t = 0.05; t < 0.8; t += 0.05) {
    const FootPoint a = kMove.at(t - kStep), b = kMove.at(t), c = kMove.at(t + kStep);
    EXPECT_NEAR(b.velocity_m_s[0], (c.position_m[0] - a.position_m[0]) / (2 * kStep), 1e-8);
    EXPECT_NEAR(b.acceleration_m_s2[2], (c.velocity_m_s[2] - a.velocity_m_s[2]) / (2 * kStep), 1e-7);
  }
}

TEST(FootMoveTest, NoTimeMeansAtTheEnd) {
  EXPECT_EQ((FootMove{{1, 1, 1}, {2, 2, 2}, 0.0}).at(0.0).position_m[0], 2.0);
}

}  // namespace
}  // namespace sprung
