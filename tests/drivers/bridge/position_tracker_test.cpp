#include "drivers/bridge/position_tracker.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr double kSpeedLimit_rad_s = 12.0;
constexpr double kQuantum_rad = 1e-6;
// In a cycle of 1 ms nothing moves further than 3 * 12 rad/s * 1 ms and two counts.
constexpr double kFarthest_rad = 0.036;

SampleTime in_time(std::int64_t time_us) { return {time_us, time_us, time_us}; }

class PositionTrackerTest : public ::testing::Test {
 protected:
  /// The sample of cycle k, received within it.
  bool add(double position_rad, int k) { return motion(position_rad, k) == Motion::kGood; }
  Motion motion(double position_rad, int k) { return tracker_.add(position_rad, in_time(1000 * k)); }
  /// A steady motion at 3 rad/s; @return cycles done.
  int move(int cycles) {
    for (int k = 0; k < cycles; ++k) EXPECT_TRUE(add(0.5 + 0.003 * k, k));
    return cycles;
  }
  PositionTracker tracker_{kSpeedLimit_rad_s, kQuantum_rad};
};

TEST_F(PositionTrackerTest, VelocitySettlesOnASteadyMotion) {
  move(100);
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST_F(PositionTrackerTest, MissedSamplesDoNotDoubleTheVelocity) {
  for (int k = 0; k < 300; ++k) {
    if (k % 3 != 1) add(0.003 * k, k);
  }
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST_F(PositionTrackerTest, FirstSampleIsNoMotion) {
  EXPECT_TRUE(add(100.0, 0));
  EXPECT_EQ(tracker_.filtered_velocity_rad_s(), 0.0);
  EXPECT_EQ(tracker_.position_rad(), 100.0);
}

TEST_F(PositionTrackerTest, StepsUpToThriceTheSpeedLimitAreMotion) {
  EXPECT_TRUE(add(1.0, 0));
  EXPECT_TRUE(add(1.0 + 0.99 * kFarthest_rad, 1));
  EXPECT_FALSE(add(1.0 + 2.1 * kFarthest_rad, 2));
}

TEST_F(PositionTrackerTest, CountsOfACoarseEncoderAreNoJump) {
  PositionTracker coarse(0.001, 0.01);
  EXPECT_EQ(coarse.add(0.0, in_time(0)), Motion::kGood);
  EXPECT_EQ(coarse.add(0.02, in_time(1000)), Motion::kGood);
  EXPECT_EQ(coarse.add(0.05, in_time(2000)), Motion::kRejected);
}

TEST_F(PositionTrackerTest, OneFlippedSampleTouchesNeitherPositionNorVelocity) {
  const int k = move(100);
  EXPECT_FALSE(add(50.0, k));
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
  EXPECT_NEAR(tracker_.position_rad(), 0.5 + 0.003 * (k - 1), 1e-12);
  EXPECT_TRUE(add(0.5 + 0.003 * (k + 1), k + 1)) << "the motion goes on where it was";
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST_F(PositionTrackerTest, JumpThatStaysIsNewPositionWithoutNewVelocity) {
  int k = move(100);
  for (int i = 0; i < 4; ++i, ++k) {
    EXPECT_EQ(motion(50.0 + 0.003 * i, k), Motion::kRejected);
    EXPECT_LT(tracker_.position_rad(), 1.0);
  }
  EXPECT_EQ(motion(50.012, k), Motion::kJumped);
  EXPECT_EQ(tracker_.position_rad(), 50.012);
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
  EXPECT_TRUE(add(50.015, k + 1));
  EXPECT_NEAR(tracker_.filtered_velocity_rad_s(), 3.0, 1e-6);
}

TEST_F(PositionTrackerTest, JumpThatDoesNotStayIsNone) {
  int k = move(100);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(motion(50.0, k++), Motion::kRejected);
  EXPECT_TRUE(add(0.5 + 0.003 * k, k)) << "back where it was";
  EXPECT_EQ(motion(50.0, k + 1), Motion::kRejected) << "counted anew";
}

TEST_F(PositionTrackerTest, SamplesThatJumpToAndFroAreAllRejected) {
  int k = move(10);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(add(i % 2 == 0 ? 50.0 : -50.0, k++));
}

TEST_F(PositionTrackerTest, CycleThatWasSentLateIsNoJumpAndNoSpeed) {
  EXPECT_TRUE(add(0.0, 0));
  // SYNC of cycle 1 left 20 ms after its time stamp: the answer shows 21 ms of motion.
  EXPECT_EQ(tracker_.add(0.21, {1000, 1000, 21'000}), Motion::kGood);
  EXPECT_LE(tracker_.filtered_velocity_rad_s(), 3.0 * kSpeedLimit_rad_s * 0.2 + 1e-9);
  EXPECT_EQ(tracker_.add(1.5, {22'000, 22'000, 22'100}), Motion::kRejected);
}

TEST_F(PositionTrackerTest, MotionSinceTheOldestSyncThatASampleMayAnswerIsNoJump) {
  EXPECT_TRUE(add(0.0, 0));
  EXPECT_EQ(tracker_.add(0.003, {20'000, 1000, 20'000}), Motion::kGood) << "of cycle 1, came in cycle 20";
  EXPECT_EQ(tracker_.add(0.063, in_time(21'000)), Motion::kGood) << "3 rad/s for 20 cycles";
}

TEST_F(PositionTrackerTest, JumpBeyondTheOldestSyncThatASampleMayAnswerIsRejected) {
  EXPECT_TRUE(add(0.0, 0));
  EXPECT_EQ(tracker_.add(0.003, {3000, 1000, 3000}), Motion::kGood);
  EXPECT_EQ(tracker_.add(0.003 + 3.1 * kFarthest_rad, in_time(4000)), Motion::kRejected) << "in 3 cycles";
  EXPECT_EQ(tracker_.add(0.012, in_time(5000)), Motion::kGood);
  EXPECT_EQ(tracker_.add(0.012 + 1.1 * kFarthest_rad, in_time(6000)), Motion::kRejected)
      << "known to the cycle again";
}

TEST_F(PositionTrackerTest, DriveThatBeginsAnewIsAtRestWhereItCanHaveTurned) {
  move(100);
  tracker_.resume();
  EXPECT_EQ(tracker_.filtered_velocity_rad_s(), 0.0);
  EXPECT_TRUE(add(10.0, 1000)) << "0.9 s are long enough for that";
  EXPECT_EQ(tracker_.filtered_velocity_rad_s(), 0.0) << "not a speed of the samples' gap";
  tracker_.resume();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(motion(-50.0, 1100 + i), Motion::kRejected);
  EXPECT_EQ(motion(-50.0, 1104), Motion::kJumped);
}

}  // namespace
}  // namespace sprung
