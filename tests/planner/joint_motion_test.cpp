#include "planner/joint_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class JointMotionTest : public testing::Test {
 protected:
  JointMotionTest() {
    for (std::size_t i = 0; i < 12; ++i) {
      const JointConfig& joint = robot_.joints[i];
      state_.joints[i].estimated_position_rad = 0.5 * (joint.position_min_rad + joint.position_max_rad);
    }
    EXPECT_TRUE(motion_.hold(state_));
  }
  DesiredLeg leg(std::size_t i, double time_s) const {
    DesiredLeg out;
    motion_.write(i, std::llround(1e6 * time_s), out);
    return out;
  }
  const char* validate(JointRequest request) const { return motion_.validate(request); }

  RobotConfig robot_ = load_robot("pegasus");
  JointMotion motion_{robot_};
  JointState state_{12, 4};
  const JointRequest knee_{5, 2.0, 1.0, 4.0};  // fr_knee, from 1.3
};

TEST_F(JointMotionTest, EveryLegHoldsWhatWasMeasured) {
  for (std::size_t i = 0; i < 4; ++i) {
    const DesiredLeg held = leg(i, 1.0);
    EXPECT_EQ(held.control_mode, ControlMode::kJoint);
    EXPECT_EQ(held.desired_joint_position_rad, (Vec3{0.0, 1.7, 1.3}));
    EXPECT_EQ(held.desired_joint_velocity_rad_s, (Vec3{0.0, 0.0, 0.0}));
  }
  EXPECT_TRUE(motion_.at_rest(0));
}

TEST_F(JointMotionTest, OneMovesAndAllOthersHold) {
  motion_.begin(knee_, 1'000'000);
  EXPECT_FALSE(motion_.at_rest(1'000'000));
  const DesiredLeg moving = leg(1, 1.5);
  EXPECT_NEAR(moving.desired_joint_velocity_rad_s[2], 1.0, 1e-12);
  EXPECT_GT(moving.desired_joint_position_rad[2], 1.5);
  EXPECT_EQ(moving.desired_joint_position_rad[1], 1.7);
  EXPECT_EQ(leg(0, 1.5).desired_joint_position_rad[2], 1.3);
  EXPECT_TRUE(motion_.at_rest(3'000'000));
  EXPECT_NEAR(leg(1, 3.0).desired_joint_position_rad[2], 2.0, 1e-12);
}

TEST_F(JointMotionTest, AnotherJointsMoveLeavesTheFirstWhereItWent) {
  motion_.begin(knee_, 0);
  motion_.begin({4, 1.0, 1.0, 4.0}, 5'000'000);
  const DesiredLeg later = leg(1, 10.0);
  EXPECT_NEAR(later.desired_joint_position_rad[1], 1.0, 1e-12);
  EXPECT_NEAR(later.desired_joint_position_rad[2], 2.0, 1e-12);
}

TEST_F(JointMotionTest, BrakingHoldsWhereItCameToRest) {
  motion_.begin(knee_, 0);
  motion_.brake(400'000);
  EXPECT_FALSE(motion_.at_rest(400'000));
  EXPECT_NEAR(leg(1, 0.4).desired_joint_velocity_rad_s[2], 1.0, 1e-9);
  EXPECT_TRUE(motion_.at_rest(650'001));
  const double end_rad = leg(1, 1.0).desired_joint_position_rad[2];
  EXPECT_NEAR(end_rad, 1.3 + 0.125 + 0.15 + 0.125, 1e-9);
  motion_.brake(2'000'000);
  EXPECT_EQ(leg(1, 3.0).desired_joint_position_rad[2], end_rad);
}

TEST_F(JointMotionTest, WhatWasNotMeasuredIsNotHeld) {
  state_.joints[7].estimated_position_rad = kNaN;
  EXPECT_FALSE(motion_.hold(state_));
}

TEST_F(JointMotionTest, MistakesAreNamed) {
  EXPECT_EQ(validate(knee_), nullptr);
  EXPECT_EQ(validate({5, 2.48, 4.36, 100.0}), nullptr);
  EXPECT_STREQ(validate({12, 1.0, 1.0, 1.0}), "this robot has no such joint");
  EXPECT_STREQ(validate({-1, 1.0, 1.0, 1.0}), "this robot has no such joint");
  for (const double target : {2.49, 0.11, -7.0, kNaN, kInfinity})
    EXPECT_NE(std::string(validate({5, target, 1.0, 4.0})).find("position limits"), std::string::npos);
  for (const double speed : {0.0, -1.0, 4.37, kNaN, kInfinity})
    EXPECT_NE(std::string(validate({5, 2.0, speed, 4.0})).find("speed limit"), std::string::npos);
  for (const double acceleration : {0.0, -1.0, 150.0, kNaN, kInfinity})
    EXPECT_NE(std::string(validate({5, 2.0, 1.0, acceleration})).find("acceleration"), std::string::npos);
}

TEST_F(JointMotionTest, AccelerationIsFiniteEvenWhereNoArmatureIsKnown) {
  robot_.joints[5].armature_kg_m2 = 0.0;
  const JointMotion motion(robot_);
  EXPECT_EQ(motion.validate({5, 2.0, 1.0, 1000.0}), nullptr);
  EXPECT_NE(motion.validate({5, 2.0, 1.0, kInfinity}), nullptr);
}

TEST_F(JointMotionTest, LegOfMoreJointsThanTheMessageHoldsIsRefused) {
  RobotConfig robot = robot_;
  robot.legs[0].joints = {0, 1, 2, 3};
  robot.legs[0].actuators = {0, 1, 2, 3};
  robot.legs[0].transmission = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const JointMotion motion(robot);
  EXPECT_STREQ(motion.validate(knee_), "joint moves are for legs of up to three joints");
}

}  // namespace
}  // namespace sprung
