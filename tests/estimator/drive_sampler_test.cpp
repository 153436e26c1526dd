#include "estimator/drive_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class DriveSamplerTest : public testing::Test {
 protected:
  DriveSamplerTest() {
    for (ActuatorState& a : actuators_) {
      a.measured_position_rad = 1.0;
      a.measured_current_A = 2.0;
      a.power_state = PowerState::kOperationEnabled;
      a.shown_mode = DriveMode::kPosition;
      a.referenced = true;
    }
  }
  std::vector<JointSample> sample() {
    std::vector<JointSample> samples(2);
    DriveSampler(robot_, robot_.legs[0]).sample(actuators_, samples);
    return samples;
  }

  RobotConfig robot_ = load_robot("single_leg");
  std::vector<ActuatorState> actuators_{2};
};

TEST_F(DriveSamplerTest, TorqueIsRatioTimesConstantTimesCurrent) {
  const JointSample knee = sample()[1];
  EXPECT_DOUBLE_EQ(knee.motor_torque_Nm, 100.0 * 0.044 * 2.0);
  EXPECT_NEAR(knee.current_quantisation_Nm, 0.5e-3 * 7.0 * 4.4, 1e-12);
  EXPECT_TRUE(knee.fresh);
  EXPECT_TRUE(knee.drive_enabled);
  EXPECT_EQ(knee.drive_status, JointStatus::kOk);
}

TEST_F(DriveSamplerTest, BeltCouplesPositionsAndTorquesWithoutMakingPower) {
  robot_.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  const std::vector<JointSample> samples = sample();
  EXPECT_DOUBLE_EQ(samples[1].measured_position_rad, 1.01);
  EXPECT_NEAR(samples[0].motor_torque_Nm, 8.8 - 0.01 * 8.8, 1e-12);
}

TEST_F(DriveSamplerTest, BadDriveSpoilsOnlyTheJointsItMoves) {
  actuators_[1].measured_position_rad = kNaN;
  std::vector<JointSample> samples = sample();
  EXPECT_TRUE(samples[0].fresh);
  EXPECT_DOUBLE_EQ(samples[0].measured_position_rad, 1.0);
  EXPECT_FALSE(samples[1].fresh);
  robot_.legs[0].transmission = {1.0, 0.5, 0.0, 1.0};
  samples = sample();
  EXPECT_FALSE(samples[0].fresh);
}

/// Found by fuzzing: a finite position of 1e145 rad gave a good joint whose estimates were NaN.
TEST_F(DriveSamplerTest, NumbersThatNobodyMeasuredAreNotFresh) {
  for (const double far : {1e145, -1e7, std::numeric_limits<double>::infinity()}) {
    actuators_[0].measured_position_rad = far;
    actuators_[1].measured_position_rad = 1.0;
    actuators_[1].measured_current_A = far;
    for (const JointSample& joint : sample()) {
      EXPECT_FALSE(joint.fresh) << far;
      EXPECT_LT(std::abs(joint.measured_position_rad) + std::abs(joint.motor_torque_Nm), 10.0) << far;
    }
  }
  actuators_[0].measured_position_rad = actuators_[1].measured_current_A = 1e5;
  for (const JointSample& joint : sample()) EXPECT_TRUE(joint.fresh);
}

TEST_F(DriveSamplerTest, LinkEncodersAreSeenThroughTheTransmissionAndAMissingOneSpoilsOnlyItsJoints) {
  EXPECT_TRUE(std::isnan(sample()[0].measured_link_position_rad));
  EXPECT_DOUBLE_EQ(sample()[0].motor_angle_rad, 100.0);
  actuators_[0].measured_link_position_rad = 0.9;
  EXPECT_DOUBLE_EQ(sample()[0].measured_link_position_rad, 0.9);
  EXPECT_TRUE(std::isnan(sample()[1].measured_link_position_rad));
  actuators_[1].measured_link_position_rad = 1.1;
  robot_.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  EXPECT_DOUBLE_EQ(sample()[1].measured_link_position_rad, 1.1 + 0.009);
}

TEST_F(DriveSamplerTest, OldAnswersAreNotFresh) {
  actuators_[0].age_cycles = 1;
  EXPECT_FALSE(sample()[0].fresh);
  EXPECT_TRUE(sample()[1].fresh);
}

TEST_F(DriveSamplerTest, EnabledMeansOperationEnabledAndModeShown) {
  actuators_[0].power_state = PowerState::kSwitchedOn;
  actuators_[1].shown_mode = DriveMode::kDisabled;
  EXPECT_FALSE(sample()[0].drive_enabled);
  EXPECT_FALSE(sample()[1].drive_enabled);
  actuators_[1].shown_mode = DriveMode::kTorque;
  EXPECT_TRUE(sample()[1].drive_enabled);
}

TEST_F(DriveSamplerTest, StatusNamesTheWorst) {
  actuators_[0].measured_current_A = -39.0;  // 171.6 Nm
  EXPECT_EQ(sample()[0].drive_status, JointStatus::kSaturated);
  actuators_[0].referenced = false;
  EXPECT_EQ(sample()[0].drive_status, JointStatus::kNotReferenced);
  actuators_[0].power_state = PowerState::kFault;
  EXPECT_EQ(sample()[0].drive_status, JointStatus::kFault);
}

TEST_F(DriveSamplerTest, EncoderStepIsSeenThroughTheGear) {
  const DriveSampler sampler(robot_, robot_.legs[0]);
  EXPECT_NEAR(sampler.encoder_step_rad(0), 6.283185307 / 131072.0 / 100.0, 1e-15);
}

TEST_F(DriveSamplerTest, EncoderStepsOfAParallelogramAddUpAndDoNotCancel) {
  robot_.legs[0].transmission = {1.0, 0.0, -1.0, 1.0};
  const DriveSampler sampler(robot_, robot_.legs[0]);
  const double step_rad = 6.283185307 / 131072.0 / 100.0;
  EXPECT_NEAR(sampler.encoder_step_rad(0), step_rad, 1e-15);
  EXPECT_NEAR(sampler.encoder_step_rad(1), 2.0 * step_rad, 1e-15);
}

}  // namespace
}  // namespace sprung
