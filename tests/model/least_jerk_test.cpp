#include "model/least_jerk.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(LeastJerkTest, RestsAtBothEndsAndBeyondThem) {
  for (double time_s : {-1.0, 0.0, 0.8, 2.0}) {
    const LeastJerk s = least_jerk(time_s, 0.8);
    EXPECT_EQ(s.share, time_s > 0.4 ? 1.0 : 0.0);
    EXPECT_EQ(s.rate_1_s, 0.0);
    EXPECT_EQ(s.acceleration_1_s2, 0.0);
  }
}

TEST(LeastJerkTest, IsFastestHalfWay) {
  const LeastJerk s = least_jerk(0.4, 0.8);
  EXPECT_NEAR(s.share, 0.5, 1e-15);
  EXPECT_NEAR(s.rate_1_s, 1.875 / 0.8, 1e-12);  // 15/8 of the mean
  EXPECT_NEAR(s.acceleration_1_s2, 0.0, 1e-12);
}

TEST(LeastJerkTest, DerivativesBelongToTheShare) {
  constexpr double kStep = 1e-6;
  for (double t = 0.05; t < 0.8; t += 0.05) {
    const LeastJerk a = least_jerk(t - kStep, 0.8), b = least_jerk(t, 0.8), c = least_jerk(t + kStep, 0.8);
    EXPECT_NEAR(b.rate_1_s, (c.share - a.share) / (2 * kStep), 1e-8);
    EXPECT_NEAR(b.acceleration_1_s2, (c.rate_1_s - a.rate_1_s) / (2 * kStep), 1e-6);
  }
}

}  // namespace
}  // namespace sprung
