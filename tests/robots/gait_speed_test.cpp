#include "robots/gait_speed.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

GaitConfig gait() {
  GaitConfig out;
  out.fastest_forward_m_s = 0.4;
  out.fastest_backward_m_s = 0.3;
  out.fastest_sideways_m_s = 0.1;
  out.fastest_turning_rad_s = 0.5;
  return out;
}

TEST(GaitSpeedTest, EachOfTheFastestAloneIsTheWholeOfIt) {
  EXPECT_DOUBLE_EQ(speed_share(gait(), {0.4, 0.0, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(speed_share(gait(), {-0.3, 0.0, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(speed_share(gait(), {0.0, 0.1, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(speed_share(gait(), {0.0, 0.0, -0.5}), 1.0);
  EXPECT_EQ(speed_share(gait(), {0.0, 0.0, 0.0}), 0.0);
}

TEST(GaitSpeedTest, TogetherTheyShareIt) {
  EXPECT_DOUBLE_EQ(speed_share(gait(), {0.24, 0.08, 0.0}), 1.0);
  EXPECT_GT(speed_share(gait(), {0.4, 0.05, 0.0}), kMostSpeedShare);
}

TEST(GaitSpeedTest, WhatAGaitDoesNotDoAtAllIsTooMuchAndNoNumberIsNone) {
  GaitConfig straight = gait();
  straight.fastest_sideways_m_s = 0.0;
  EXPECT_LE(speed_share(straight, {0.4, 0.0, 0.0}), kMostSpeedShare);
  EXPECT_GT(speed_share(straight, {0.0, 1e-6, 0.0}), kMostSpeedShare);
  EXPECT_FALSE(speed_share(gait(), {std::nan(""), 0.0, 0.0}) <= kMostSpeedShare);
}

}  // namespace
}  // namespace sprung
