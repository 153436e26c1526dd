#include "planner/fall_detector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

BodyConfig body() {
  BodyConfig config;
  config.mass_kg = 12.0;
  config.fallen_tilt_rad = 0.7;
  config.fallen_height_m = 0.25;
  return config;
}

EstimatedBody tilted(double angle_rad, bool roll) {
  EstimatedBody out;
  out.estimated_quaternion_wxyz = {std::cos(0.5 * angle_rad), roll ? std::sin(0.5 * angle_rad) : 0.0,
                                   roll ? 0.0 : std::sin(0.5 * angle_rad), 0.0};
  out.estimated_height_m = 0.5;
  out.uses_imu = true;
  return out;
}

TEST(FallDetectorTest, TiltBeyondTheLimitToAnySideIsAFall) {
  const FallDetector falls(body());
  for (const bool roll : {true, false}) {
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_FALSE(falls.fell(tilted(sign * 0.69, roll)));
      EXPECT_TRUE(falls.fell(tilted(sign * 0.71, roll)));
    }
  }
}

TEST(FallDetectorTest, HipsTooLowOverTheFeetAreAFall) {
  const FallDetector falls(body());
  EstimatedBody low = tilted(0.0, true);
  low.estimated_height_m = 0.251;
  EXPECT_FALSE(falls.fell(low));
  low.estimated_height_m = 0.249;
  EXPECT_TRUE(falls.fell(low));
}

TEST(FallDetectorTest, WhatIsNotKnownSaysNothing) {
  const FallDetector falls(body());
  EXPECT_FALSE(falls.fell(EstimatedBody{}));
  EXPECT_EQ(falls.why_not_up(EstimatedBody{}), nullptr);
}

TEST(FallDetectorTest, RobotWithoutABodyCannotFall) {
  const FallDetector falls{BodyConfig{}};
  EXPECT_FALSE(falls.fell(tilted(2.0, true)));
  EXPECT_EQ(falls.why_not_up(tilted(2.0, true)), nullptr);
}

TEST(FallDetectorTest, GettingUpIsRefusedOnASideOrBackButNotLyingFlat) {
  const FallDetector falls(body());
  EstimatedBody flat = tilted(0.05, false);
  flat.estimated_height_m = 0.08;
  EXPECT_EQ(falls.why_not_up(flat), nullptr);
  EXPECT_STREQ(falls.why_not_up(tilted(1.5, true)), "lying on its side or back: turn it over");
  EXPECT_STREQ(falls.why_not_up(tilted(3.1, false)), "lying on its side or back: turn it over");
}

TEST(FallDetectorTest, WithoutAnImuTheFeetDoNotSayHowItLies) {
  EstimatedBody body_without_imu = tilted(1.5, true);
  body_without_imu.uses_imu = false;
  EXPECT_EQ(FallDetector(body()).why_not_up(body_without_imu), nullptr);
}

}  // namespace
}  // namespace sprung
