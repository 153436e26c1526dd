#include "controller/controller_core.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "tests/controller/controller_fixture.h"
#include "tests/support/allocation_count.h"
#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

class ControllerCoreTest : public ControllerFixture {
 protected:
  /// Cycles with nothing but this command; joints go where the drives are told to.
  void lower_for(double duration_s, const LegCommand* old) {
    for (int i = 0; i < std::lround(1e3 * duration_s); ++i) {
      state_.stamp.utime_us += 1000;
      ++state_.stamp.seq;
      core_.step(state_, old, out_);
      if (!all(DriveMode::kPosition)) continue;
      for (std::size_t j = 0; j < 2; ++j)
        state_.joints[j].estimated_position_rad = out_.actuators[j].commanded_position_rad;
      state_.legs[0].estimated_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(measured()));
    }
  }
  void expect_damping(CommandBasis basis) {
    EXPECT_TRUE(all(DriveMode::kDamping));
    EXPECT_EQ(core_.basis(), basis) << name(core_.basis());
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(out_.actuators[i].commanded_damping_Nm_s_rad, robot_.actuators[i].safety_damping_Nm_s_rad);
    }
  }
};

TEST_F(ControllerCoreTest, StampsWhatItUsedAndHowLongItHolds) {
  cycle();
  EXPECT_EQ(out_.stamp.seq, 101);
  EXPECT_EQ(out_.used_joint_state_seq, 101);
  EXPECT_EQ(out_.used_leg_command_seq, 100);
  EXPECT_EQ(out_.valid_until_utime_us, 101000 + 20000 + 1000);
  EXPECT_EQ(core_.basis(), CommandBasis::kCommanded);
}

TEST_F(ControllerCoreTest, BeforeTheFirstCommandNothingIsSwitchedOnOrDropped) {
  core_.step(state_, nullptr, out_);
  expect_damping(CommandBasis::kNoCommand);
  for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = false;
  core_.step(state_, nullptr, out_);
  EXPECT_TRUE(all(DriveMode::kDisabled));
}

TEST_F(ControllerCoreTest, DisabledAndDampingArePassedOn) {
  want(ControlMode::kDisabled);
  cycle();
  EXPECT_TRUE(all(DriveMode::kDisabled));
  want(ControlMode::kDamping);
  cycle();
  expect_damping(CommandBasis::kCommanded);
}

TEST_F(ControllerCoreTest, DisabledNeedsNoReadyJoint) {
  want(ControlMode::kDisabled);
  state_.joints[0].status = JointStatus::kStale;
  cycle();
  EXPECT_TRUE(all(DriveMode::kDisabled));
}

TEST_F(ControllerCoreTest, OldCommandLowersTheRobotAfterTheWatchdogsTimeThenDamps) {
  cycle();
  const LegCommand old = command_;
  state_.stamp.utime_us = old.stamp.utime_us + 20000;
  core_.step(state_, &old, out_);
  EXPECT_EQ(core_.basis(), CommandBasis::kCommanded);
  state_.stamp.utime_us += 1;
  core_.step(state_, &old, out_);
  EXPECT_TRUE(all(DriveMode::kPosition));
  EXPECT_EQ(core_.basis(), CommandBasis::kLowering) << name(core_.basis());
  lower_for(1.19, &old);
  EXPECT_NEAR(leg_->foot_in_hip_m(measured()).z(), -0.28, 0.01) << "sit_length of the preset";
  lower_for(0.02, &old);
  expect_damping(CommandBasis::kCommandStale);
  lower_for(0.5, &old);
  expect_damping(CommandBasis::kCommandStale);
}

TEST_F(ControllerCoreTest, CommandsThatComeBackEndALowering) {
  cycle();
  const LegCommand old = command_;
  lower_for(0.1, &old);
  ASSERT_EQ(core_.basis(), CommandBasis::kLowering);
  cycle();
  EXPECT_EQ(core_.basis(), CommandBasis::kCommanded);
  const LegCommand again = command_;
  lower_for(0.1, &again);
  EXPECT_EQ(core_.basis(), CommandBasis::kLowering);
}

TEST_F(ControllerCoreTest, BridgeThatLowersIsObeyedWhateverThePlannerSays) {
  cycle();
  state_.safety = SafetyLevel::kLowering;
  cycle();
  EXPECT_EQ(core_.basis(), CommandBasis::kLowering);
  EXPECT_TRUE(all(DriveMode::kPosition));
}

TEST_F(ControllerCoreTest, WhatWasCommandedBeforeAStopIsNoReasonToMoveAfterIt) {
  cycle();
  const LegCommand old = command_;
  state_.safety = SafetyLevel::kDamping;
  cycle();
  state_.safety = SafetyLevel::kOperational;
  state_.stamp.utime_us += 30000;
  lower_for(0.1, &old);
  expect_damping(CommandBasis::kCommandStale);
}

TEST_F(ControllerCoreTest, LoweringSwitchesNoDriveOnThatFellOff) {
  cycle();
  const LegCommand old = command_;
  lower_for(0.1, &old);
  ASSERT_EQ(core_.basis(), CommandBasis::kLowering);
  state_.joints[1].drive_enabled = false;
  lower_for(0.001, &old);
  expect_damping(CommandBasis::kCommandStale);
}

TEST_F(ControllerCoreTest, NothingThatGoesWrongSwitchesAnIdleRobotOn) {
  const auto expect_off = [this](CommandBasis basis) {
    EXPECT_EQ(core_.basis(), basis) << name(core_.basis());
    EXPECT_TRUE(all(DriveMode::kDisabled)) << name(basis);
  };
  for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = false;
  core_.step(state_, nullptr, out_);
  expect_off(CommandBasis::kNoCommand);
  cycle();
  EXPECT_TRUE(all(DriveMode::kPosition));  // as LEG_COMMAND asks: this is how a drive is switched on
  const LegCommand dead_planners = command_;
  state_.stamp.utime_us += 30000;
  core_.step(state_, &dead_planners, out_);
  expect_off(CommandBasis::kCommandStale);
  state_.joints[0].status = JointStatus::kFault;
  cycle();
  expect_off(CommandBasis::kJointNotReady);
  state_.joints[0].status = JointStatus::kOk;
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.9};
  cycle();
  expect_off(CommandBasis::kUnreachable);
  state_.safety = SafetyLevel::kDamping;
  cycle();
  expect_off(CommandBasis::kSafety);
}

TEST_F(ControllerCoreTest, LegThatOneDriveHoldsIsDampedNotDropped) {
  cycle();
  state_.joints[0].drive_enabled = false;
  const LegCommand dead_planners = command_;
  state_.stamp.utime_us += 30000;
  core_.step(state_, &dead_planners, out_);
  expect_damping(CommandBasis::kCommandStale);
}

TEST_F(ControllerCoreTest, CommandFromTheFutureOrOfAnotherRobotIsDamping) {
  command_.stamp = {state_.stamp.utime_us + 1000, 99};
  core_.step(state_, &command_, out_);
  expect_damping(CommandBasis::kCommandStale);
  LegCommand two_legs(2);
  two_legs.stamp = state_.stamp;
  core_.step(state_, &two_legs, out_);
  expect_damping(CommandBasis::kCommandStale);
}

TEST_F(ControllerCoreTest, JointsThatAreNotReadyAreDamped) {
  for (JointStatus status :
       {JointStatus::kStarting, JointStatus::kStale, JointStatus::kNotReferenced, JointStatus::kFault}) {
    state_.joints[1].status = status;
    cycle();
    expect_damping(CommandBasis::kJointNotReady);
  }
  state_.joints[1].status = JointStatus::kSaturated;
  cycle();
  EXPECT_TRUE(all(DriveMode::kPosition));
}

TEST_F(ControllerCoreTest, NumbersThatAreNotFiniteAreDamping) {
  state_.joints[0].estimated_velocity_rad_s = kNaN;
  cycle();
  expect_damping(CommandBasis::kNotFinite);
  state_.joints[0].estimated_velocity_rad_s = 0.0;
  for (ControlMode mode : {ControlMode::kPosition, ControlMode::kCompliance}) {
    want(mode);
    command_.legs[0].desired_foot_in_hip_m[0] = kNaN;
    cycle();
    expect_damping(CommandBasis::kNotFinite);
    command_.legs[0].desired_foot_in_hip_m[0] = 0.0;
  }
  command_.legs[0].stiffness_N_m[2] = kNaN;
  cycle();
  expect_damping(CommandBasis::kNotFinite);
}

TEST_F(ControllerCoreTest, FootOutOfReachIsDamping) {
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.9};
  cycle();
  expect_damping(CommandBasis::kUnreachable);
}

TEST_F(ControllerCoreTest, SafetyComesFirst) {
  for (SafetyLevel level : {SafetyLevel::kDamping, SafetyLevel::kQuickStop}) {
    state_.safety = level;
    cycle();
    expect_damping(CommandBasis::kSafety);
  }
  state_.safety = SafetyLevel::kDisabled;
  cycle();
  EXPECT_TRUE(all(DriveMode::kDisabled));
}

TEST_F(ControllerCoreTest, AfterDampingThePositionBeginsAtTheMeasuredPoseAgain) {
  cycles(50);
  state_.joints[0].status = JointStatus::kStale;
  cycle();
  set_joints(measured() + pair(0.1, -0.1));
  cycle();
  EXPECT_TRUE(all(DriveMode::kPosition));
  EXPECT_LT((commanded_position() - measured()).norm(), 1e-9);
}

TEST_F(ControllerCoreTest, SmoothingMustBePositive) {
  PresetConfig preset = robot_.preset("paper");
  preset.friction_smoothing_rad_s = 0.0;
  EXPECT_THROW(ControllerCore(robot_, preset, robot_.watchdogs), std::invalid_argument);
}

TEST_F(ControllerCoreTest, IdentifiedFrictionChangesPresetBestAndNotPaper) {
  for (JointConfig& joint : robot_.joints) joint.friction.reset();
  RobotConfig identified = robot_;
  for (JointConfig& joint : identified.joints) {
    joint.friction.emplace();
    joint.friction->parameters.coulomb_Nm = 7.3;
  }
  want(ControlMode::kCompliance);
  command_.legs[0].friction_compensation = 0.5;
  const auto torque = [this](const RobotConfig& robot, const char* preset) {
    PresetConfig by_speed = robot.preset(preset);
    by_speed.rest_friction = {};  // its sign would be the spring's
    ControllerCore core(robot, by_speed, robot.watchdogs);
    for (int k = 0; k < 100; ++k) {  // until the fade at the beginning is over
      for (EstimatedJoint& joint : state_.joints) joint.estimated_velocity_rad_s = 1.0;
      command_.stamp = state_.stamp = {state_.stamp.utime_us + 1000, state_.stamp.seq + 1};
      core.step(state_, &command_, out_);
    }
    return commanded_torque();
  };
  EXPECT_EQ(torque(identified, "paper"), torque(robot_, "paper"));
  const JointVector more_Nm = torque(identified, "best") - torque(robot_, "best");
  EXPECT_NEAR(more_Nm[0], 0.5 * (7.3 - 1.79), 1e-9);
  EXPECT_NEAR(more_Nm[1], 0.5 * (7.3 - 1.79), 1e-9);
}

TEST_F(ControllerCoreTest, ComplianceBeginsAtTheMotorsTorqueWhateverFrictionIsSaid) {
  cycles(40);
  for (EstimatedJoint& joint : state_.joints) {
    joint.estimated_velocity_rad_s = 1.0;
    joint.measured_motor_torque_Nm = 10.0;
    joint.motor_side_torque_Nm = 10.0 - 1.79;  // the papers'
    joint.friction_torque_Nm = 7.3;            // of another law
  }
  want(ControlMode::kCompliance);
  cycle();
  EXPECT_NEAR(commanded_torque()[0], 10.0, 1e-9);
  EXPECT_NEAR(commanded_torque()[1], 10.0, 1e-9);
}

TEST_F(ControllerCoreTest, EveryBasisHasAName) {
  EXPECT_TRUE(is_dense<CommandBasis>());
  EXPECT_TRUE(is_known<CommandBasis>(static_cast<int>(CommandBasis::kLowering)));
}

TEST_F(ControllerCoreTest, RandomStatesNeverExceedLimitsNorAllocateNorDifferBetweenTwins) {
  ControllerCore twin(robot_, robot_.preset("paper"), robot_.watchdogs);
  DriveCommand twin_out(2);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 3000; ++k) {
    if (k % 50 == 0) want(k % 100 == 0 ? ControlMode::kPosition : ControlMode::kCompliance);
    set_joints(pair(1.7 + 1.9 * unit(random), 1.3 + 1.3 * unit(random)), 100.0 * unit(random));
    state_.joints[0].estimated_velocity_rad_s = 12.0 * unit(random);
    command_.legs[0].desired_foot_in_hip_m = {0.2 * unit(random), 0.0, -0.4 + 0.2 * unit(random)};
    command_.legs[0].desired_foot_velocity_m_s = {0.0, 0.0, 5.0 * unit(random)};
    const std::int64_t before = test::allocation_count();
    cycle();
    ASSERT_EQ(test::allocation_count(), before);
    twin.step(state_, &command_, twin_out);
    for (std::size_t i = 0; i < 2; ++i) {
      const ActuatorCommand& a = out_.actuators[i];
      ASSERT_LE(std::abs(a.commanded_torque_Nm), robot_.actuators[i].torque_limit_Nm);
      ASSERT_LE(std::abs(a.commanded_velocity_rad_s), robot_.actuators[i].speed_limit_rad_s);
      ASSERT_EQ(a.mode, twin_out.actuators[i].mode);
      ASSERT_EQ(a.commanded_torque_Nm, twin_out.actuators[i].commanded_torque_Nm);
      if (a.mode == DriveMode::kPosition) {
        ASSERT_TRUE(std::isfinite(a.commanded_position_rad));
        ASSERT_EQ(a.commanded_position_rad, twin_out.actuators[i].commanded_position_rad);
      }
    }
  }
}

TEST(ControllerWithoutFeet, DampsAndSwitchesOffButGoesNowhere) {
  const RobotConfig robot = test::pegasus_without_feet();
  ControllerCore core(robot, robot.preset("best"), robot.watchdogs);
  JointState state(12, 4);
  state.safety = SafetyLevel::kOperational;
  for (EstimatedJoint& joint : state.joints) {
    joint.estimated_position_rad = 1.0;
    joint.estimated_velocity_rad_s = joint.gear_output_torque_Nm = 0.0;
    joint.status = JointStatus::kOk;
    joint.drive_enabled = true;
  }
  LegCommand command(4);
  DriveCommand out(12);
  const auto step = [&](ControlMode mode) {
    for (DesiredLeg& leg : command.legs) leg.control_mode = mode;
    command.stamp = state.stamp;
    state.stamp = {state.stamp.utime_us + 2000, state.stamp.seq + 1};
    core.step(state, &command, out);
    return core.basis();
  };
  EXPECT_EQ(step(ControlMode::kDisabled), CommandBasis::kCommanded);
  for (const ActuatorCommand& a : out.actuators) EXPECT_EQ(a.mode, DriveMode::kDisabled);
  EXPECT_EQ(step(ControlMode::kDamping), CommandBasis::kCommanded);
  for (const ActuatorCommand& a : out.actuators) EXPECT_EQ(a.mode, DriveMode::kDamping);
  for (const ControlMode mode : {ControlMode::kPosition, ControlMode::kCompliance}) {
    EXPECT_EQ(step(mode), CommandBasis::kUnreachable);
    for (const ActuatorCommand& a : out.actuators) EXPECT_EQ(a.mode, DriveMode::kDamping);
  }
}

}  // namespace
}  // namespace sprung
