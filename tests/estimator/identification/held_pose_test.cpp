#include "estimator/identification/held_pose.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

/// A joint that needs 6 Nm for its pose, with noise of 0.05 Nm; 10 s at 100 Hz.
JointDataset held() {
  JointDataset data = swinging_joint(1000);
  data.position_rad.setConstant(0.3);
  for (Eigen::Index i = 0; i < data.size(); ++i) data.measured_torque[i] = 6.0 + 0.05 * noise(2, i);
  return data;
}

/// Somebody pushes toward +q with `torque_Nm`: the motor gives that much less.
void push(JointDataset& data, double from_s, double to_s, double torque_Nm) {
  for (Eigen::Index i = 0; i < data.size(); ++i) {
    if (data.time_s[i] >= from_s && data.time_s[i] < to_s) data.measured_torque[i] -= torque_Nm;
  }
}

HeldPoseOptions with_breakaway(double torque_Nm) {
  HeldPoseOptions options;
  options.breakaway = torque_Nm;
  return options;
}

TEST(HeldPose, PushesAreFoundWithSizeAndDirection) {
  JointDataset data = held();
  push(data, 3.0, 4.0, 8.0);
  push(data, 6.0, 6.5, -9.0);
  const HeldPose found = find_pushes(data, with_breakaway(2.0));
  EXPECT_NEAR(found.torque, 6.0, 0.02);
  EXPECT_NEAR(found.noise, 0.05, 0.015);
  ASSERT_EQ(found.pushes.size(), 2u);
  EXPECT_NEAR(found.pushes[0].from_s, 3.0, 0.011);
  EXPECT_NEAR(found.pushes[0].to_s, 4.0, 0.021);
  EXPECT_NEAR(found.pushes[0].external, 8.0, 0.2);
  EXPECT_TRUE(found.pushes[0].certain);
  EXPECT_NEAR(found.pushes[1].external, -9.0, 0.2);
}

TEST(HeldPose, WhatFrictionMayHideIsFoundButNotCertain) {
  JointDataset data = held();
  push(data, 3.0, 4.0, 3.0);  // between once and twice the breakaway torque
  const HeldPose found = find_pushes(data, with_breakaway(2.0));
  ASSERT_EQ(found.pushes.size(), 1u);
  EXPECT_FALSE(found.pushes[0].certain);
  EXPECT_GT(found.pushes[0].bound, 4.0);
}

TEST(HeldPose, BelowBreakawayAndNoiseNothingIsFound) {
  JointDataset data = held();
  push(data, 3.0, 4.0, 1.5);
  EXPECT_TRUE(find_pushes(data, with_breakaway(2.0)).pushes.empty());
  EXPECT_TRUE(find_pushes(held(), with_breakaway(0.0)).pushes.empty());
}

TEST(HeldPose, AChangeOfDirectionIsTwoPushes) {
  JointDataset data = held();
  push(data, 3.0, 4.0, 8.0);
  push(data, 4.0, 5.0, -8.0);
  EXPECT_EQ(find_pushes(data, with_breakaway(2.0)).pushes.size(), 2u);
}

TEST(HeldPose, AnInstantIsNoPush) {
  JointDataset data = held();
  push(data, 3.0, 3.03, 50.0);
  EXPECT_TRUE(find_pushes(data, with_breakaway(2.0)).pushes.empty());
}

TEST(HeldPose, APushThatLastsToTheEndCounts) {
  JointDataset data = held();
  push(data, 9.0, 99.0, 8.0);
  EXPECT_EQ(find_pushes(data, with_breakaway(2.0)).pushes.size(), 1u);
}

TEST(HeldPose, AJointThatMovesIsRefused) {
  JointDataset data = held();
  data.position_rad[500] += 0.02;
  EXPECT_THROW(find_pushes(data, with_breakaway(2.0)), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::identification
