#include "tools/lab/estimation/estimator_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

EstimatedJoint estimated(double output_Nm, double bound_Nm, JointStatus status = JointStatus::kOk) {
  EstimatedJoint joint;
  joint.gear_output_torque_Nm = output_Nm;
  joint.gear_output_torque_bound_Nm = bound_Nm;
  joint.motor_side_torque_Nm = output_Nm + 50.0;
  joint.status = status;
  return joint;
}

TrueJoint truth(double output_Nm) {
  TrueJoint joint;
  joint.true_gear_output_torque_Nm = output_Nm;
  return joint;
}

TEST(TorqueScoreTest, NoSamplesIsNoFigure) {
  EXPECT_TRUE(std::isnan(TorqueScore().rms_Nm()));
  EXPECT_TRUE(std::isnan(TorqueScore().covered()));
}

TEST(TorqueScoreTest, SumsErrorsOfBothTorquesAndCountsBoundsThatHold) {
  TorqueScore score;
  score.add(estimated(13.0, 2.0), truth(10.0));
  score.add(estimated(6.0, 4.0), truth(10.0));  // exactly at its bound
  EXPECT_EQ(score.samples(), 2);
  EXPECT_DOUBLE_EQ(score.rms_Nm(), std::sqrt((9.0 + 16.0) / 2.0));
  EXPECT_DOUBLE_EQ(score.papers_rms_Nm(), std::sqrt((53.0 * 53.0 + 46.0 * 46.0) / 2.0));
  EXPECT_DOUBLE_EQ(score.covered(), 0.5);
  EXPECT_DOUBLE_EQ(score.mean_bound_Nm(), 3.0);
}

TEST(TorqueScoreTest, WhatTheEstimatorDoesNotStandForIsLeftOutAndAMissingBoundHoldsNothing) {
  TorqueScore score;
  for (JointStatus status : {JointStatus::kStarting, JointStatus::kStale, JointStatus::kFault})
    score.add(estimated(13.0, 2.0, status), truth(10.0));
  score.add(estimated(kNaN, 2.0), truth(10.0));
  EXPECT_EQ(score.samples(), 0);
  score.add(estimated(10.0, kNaN, JointStatus::kSaturated), truth(10.0));
  EXPECT_EQ(score.samples(), 1);
  EXPECT_EQ(score.covered(), 0.0);
}

TEST(TorqueScoreTest, PoolsBySamplesAndNotByRuns) {
  TorqueScore one, many;
  one.add(estimated(14.0, 1.0), truth(10.0));
  for (int i = 0; i < 3; ++i) many.add(estimated(10.0, 1.0), truth(10.0));
  many.add(one);
  EXPECT_DOUBLE_EQ(many.rms_Nm(), 2.0);
  EXPECT_DOUBLE_EQ(many.covered(), 0.75);
}

class JumpWindowTest : public testing::Test {
 protected:
  using Part = JumpWindow::Part;
  Part at(int time_ms, MotionPhase phase, double force_N) {
    MotionState motion(1);
    motion.state = phase;
    SimTruth truth(2, 1);
    truth.stamp.utime_us = 1000 * time_ms;
    truth.legs[0].true_contact_force_N[2] = force_N;
    return window_.add(motion, truth);
  }
  JumpWindow window_;
};

TEST_F(JumpWindowTest, GoesFromThrustToTheEndOfTheLanding) {
  EXPECT_EQ(at(0, MotionPhase::kCrouch, 50.0), Part::kOther);
  EXPECT_EQ(at(10, MotionPhase::kThrust, 50.0), Part::kPushOff);
  EXPECT_EQ(at(90, MotionPhase::kThrust, 300.0), Part::kPushOff);
  EXPECT_EQ(at(100, MotionPhase::kThrust, 0.0), Part::kFlight);
  EXPECT_EQ(at(500, MotionPhase::kFlight, 20.0), Part::kLanding);
  EXPECT_EQ(window_.since_s(), 0.0);
  EXPECT_EQ(at(650, MotionPhase::kLanding, 60.0), Part::kLanding);
  EXPECT_NEAR(window_.since_s(), 0.15, 1e-12);
  EXPECT_FALSE(window_.complete());
  EXPECT_EQ(at(651, MotionPhase::kLanding, 60.0), Part::kOther);
  EXPECT_TRUE(window_.complete());
}

TEST_F(JumpWindowTest, AShortHopIsNoFlight) {
  at(10, MotionPhase::kThrust, 50.0);
  at(20, MotionPhase::kThrust, 0.0);
  EXPECT_EQ(at(40, MotionPhase::kThrust, 20.0), Part::kPushOff);
}

}  // namespace
}  // namespace sprung
