#include "tools/lab/campaign/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

/// A leg that rests in the middle of its limits under a stack that says all is well; each test makes one
/// thing bad, and the judge must name that rule and no other.
class JudgeTest : public testing::Test {
 protected:
  JudgeTest() : truth_(robot_.joints.size(), robot_.legs.size()), torques_(robot_.actuators.size()) {
    said_.level = SafetyLevel::kOperational;
    said_.cause = SafetyCause::kNone;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      truth_.joints[j].true_position_rad = 0.5 * (robot_.joints[j].position_min_rad +
                                                  robot_.joints[j].position_max_rad);
      truth_.joints[j].true_velocity_rad_s = 0.0;
      truth_.joints[j].true_motor_torque_Nm = 0.0;
    }
  }
  void look(double seconds) {
    for (double t = 0.0; t < seconds; t += robot_.cycle_s) judge_.look({++seq_, &truth_, &torques_, &said_});
  }
  void latch(SafetyLevel level) {
    said_.level = level;
    said_.cause = SafetyCause::kImplausible;
    said_.latched = true;
  }
  void answer(PowerState state) {
    FrameBatch frames;
    CanFrame frame;
    frame.id = 0x180U + static_cast<std::uint32_t>(robot_.actuators[0].node);
    frame.length = 8;
    const std::uint16_t word = cia402_word(state);
    frame.data[6] = static_cast<std::uint8_t>(word);
    frame.data[7] = static_cast<std::uint8_t>(word >> 8);
    DriveSetpoint here;
    here.commanded_position_rad = truth_.joints[0].true_position_rad;
    const CanFrame counts = profile_->encode_setpoint(here);
    std::copy(&counts.data[2], &counts.data[6], &frame.data[0]);
    frames.push(robot_.actuators[0].bus, frame);
    judge_.answered(frames);
  }
  static std::uint16_t cia402_word(PowerState state) {
    return state == PowerState::kOperationEnabled ? 0x0237 : 0x0250;
  }
  void send(const DriveSetpoint& setpoint, int torque_counts_more = 0) {
    FrameBatch frames;
    CanFrame frame = profile_->encode_setpoint(setpoint);
    const int torque = static_cast<std::int16_t>(frame.data[0] | frame.data[1] << 8) + torque_counts_more;
    frame.data[0] = static_cast<std::uint8_t>(torque);
    frame.data[1] = static_cast<std::uint8_t>(torque >> 8);
    frames.push(robot_.actuators[0].bus, frame);
    judge_.sent(frames);
  }
  void expect_only(Rule rule) {
    ASSERT_EQ(judge_.breaches().size(), 1u);
    EXPECT_EQ(judge_.breaches()[0].rule, rule) << name(judge_.breaches()[0].rule);
  }
  void expect_none() { EXPECT_TRUE(judge_.breaches().empty()) << judge_.breaches()[0].detail; }

  const RobotConfig robot_ = load_robot("single_leg");
  const std::unique_ptr<DriveProfile> profile_ = make_profile(
      robot_.actuators[0], {robot_.cycle_s, robot_.watchdogs.heartbeat_s, 0.02});
  SimTruth truth_;
  std::vector<double> torques_;
  SafetyState said_;
  Judge judge_{robot_};
  std::int64_t seq_ = -1;
};

TEST_F(JudgeTest, RobotThatRestsBreaksNothing) {
  look(10.0);
  expect_none();
}

TEST_F(JudgeTest, JointDrivenIntoItsStopWithoutACause) {
  truth_.joints[1].true_position_rad = robot_.joints[1].position_max_rad + 0.06;
  truth_.joints[1].true_motor_torque_Nm = 1.0;
  look(0.045);
  expect_none();
  look(0.02);
  expect_only(Rule::kBeyondLimit);
}

TEST_F(JudgeTest, JointThatLeansOnAStopFiftyMilliradiansBeyondIsNotBeyondIt) {
  truth_.joints[1].true_position_rad = robot_.joints[1].position_max_rad + 0.0505;
  truth_.joints[1].true_motor_torque_Nm = 1.0;
  look(0.2);
  expect_none();
}

TEST_F(JudgeTest, JointThatItsMotorPullsBackOrWhoseStopIsNamedMayBeBeyond) {
  truth_.joints[1].true_position_rad = robot_.joints[1].position_max_rad + 0.06;
  truth_.joints[1].true_motor_torque_Nm = -1.0;
  look(0.2);
  expect_none();
  truth_.joints[1].true_motor_torque_Nm = 1.0;
  latch(SafetyLevel::kDamping);
  look(0.2);
  expect_none();
}

TEST_F(JudgeTest, JointThatRunsAwayWithoutACause) {
  truth_.joints[0].true_velocity_rad_s = -1.3 * robot_.actuators[0].speed_limit_rad_s;
  look(0.06);
  expect_none();
  look(0.02);
  expect_only(Rule::kTooFast);
}

TEST_F(JudgeTest, DampingThatDrives) {
  latch(SafetyLevel::kDamping);
  truth_.joints[0].true_velocity_rad_s = 2.0;
  truth_.joints[0].true_motor_torque_Nm = -20.0;
  look(0.5);
  expect_none();
  truth_.joints[0].true_motor_torque_Nm = 20.0;  // 40 W
  look(0.03);
  expect_only(Rule::kDrivingStop);
}

TEST_F(JudgeTest, TorqueOfAThrustMayFallFirst) {
  latch(SafetyLevel::kDamping);
  truth_.joints[0].true_velocity_rad_s = 7.0;
  truth_.joints[0].true_motor_torque_Nm = 170.0;
  look(0.009);
  expect_none();
  look(0.01);
  expect_only(Rule::kDrivingStop);
}

TEST_F(JudgeTest, TorqueThatStaysAfterAStop) {
  latch(SafetyLevel::kDamping);
  torques_[0] = 3.0;
  look(7.0);
  expect_none();
  look(0.3);
  expect_only(Rule::kTorqueStays);
}

TEST_F(JudgeTest, TorqueUnderABridgeThatHasFallenSilent) {
  torques_[0] = 3.0;
  judge_.sent({});
  look(0.06);
  expect_none();
  look(0.01);
  expect_only(Rule::kTorqueStays);
}

TEST_F(JudgeTest, RobotWithMoreActuatorsThanJointsIsRefused) {
  RobotConfig robot = robot_;
  robot.actuators.push_back(robot.actuators[0]);
  EXPECT_THROW(Judge{robot}, std::invalid_argument);
}

TEST_F(JudgeTest, TorqueWhileTheStackSaysDisabled) {
  latch(SafetyLevel::kDisabled);
  torques_[0] = 3.0;
  look(0.2);
  expect_only(Rule::kDisagrees);
}

TEST_F(JudgeTest, PowerThatNobodyAskedForAfterAStop) {
  answer(PowerState::kOperationEnabled);
  latch(SafetyLevel::kQuickStop);
  look(0.1);
  answer(PowerState::kSwitchOnDisabled);
  said_ = {};
  said_.level = SafetyLevel::kOperational;
  look(0.1);
  answer(PowerState::kOperationEnabled);
  expect_only(Rule::kUncommandedEnable);
}

TEST_F(JudgeTest, PowerThatAnOperatorAskedForIsHis) {
  answer(PowerState::kOperationEnabled);
  latch(SafetyLevel::kQuickStop);
  look(0.1);
  answer(PowerState::kSwitchOnDisabled);
  said_ = {};
  said_.level = SafetyLevel::kOperational;
  judge_.operator_asked();
  look(0.1);
  answer(PowerState::kOperationEnabled);
  EXPECT_TRUE(judge_.any_enabled());
  expect_none();
}

TEST_F(JudgeTest, SetpointBeyondTheTorqueLimitOrFarBeyondTheJoint) {
  look(robot_.cycle_s);
  answer(PowerState::kOperationEnabled);
  DriveSetpoint most;
  most.commanded_torque_Nm = robot_.actuators[0].torque_limit_Nm;
  most.commanded_position_rad = robot_.joints[0].position_max_rad + 0.1;
  most.mode = DriveMode::kPosition;
  send(most);
  expect_none();
  send(most, 5);
  expect_only(Rule::kBadSetpoint);
  judge_ = Judge(robot_);
  look(robot_.cycle_s);
  answer(PowerState::kOperationEnabled);
  most.commanded_position_rad = robot_.joints[0].position_max_rad + 0.3;
  send(most);
  expect_only(Rule::kBadSetpoint);
}

TEST_F(JudgeTest, CountBeforeTheFirstCycleTellsNoZero) {
  answer(PowerState::kSwitchOnDisabled);  // while the drives boot nobody has said where the joint is
  look(robot_.cycle_s);
  answer(PowerState::kOperationEnabled);  // the same count: it rests
  DriveSetpoint here;
  here.commanded_position_rad = truth_.joints[0].true_position_rad;
  here.mode = DriveMode::kPosition;
  send(here);
  expect_none();
  here.commanded_position_rad = robot_.joints[0].position_max_rad + 0.3;
  send(here);
  expect_only(Rule::kBadSetpoint);
}

TEST_F(JudgeTest, EncoderThatSticksMakesNoSetpointBad) {
  look(robot_.cycle_s);
  answer(PowerState::kOperationEnabled);
  DriveSetpoint inside;
  inside.commanded_position_rad = robot_.joints[0].position_max_rad;
  inside.mode = DriveMode::kPosition;
  const double shown_rad = truth_.joints[0].true_position_rad;
  truth_.joints[0].true_position_rad += 0.5;  // and the encoder does not say so
  look(robot_.cycle_s);
  truth_.joints[0].true_position_rad = shown_rad;
  answer(PowerState::kOperationEnabled);
  send(inside);
  expect_none();
  inside.commanded_position_rad += 0.3;
  send(inside);
  expect_only(Rule::kBadSetpoint);
}

}  // namespace
}  // namespace sprung::campaign
