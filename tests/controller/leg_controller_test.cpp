#include "controller/leg_controller.h"

#include <cmath>

#include "controller/position_window.h"
#include "tests/controller/controller_fixture.h"

namespace sprung {
namespace {

class LegControllerTest : public ControllerFixture {};

TEST_F(LegControllerTest, PositionModeSendsTheInverseWithItsSpeed) {
  command_.legs[0].desired_foot_velocity_m_s = {0.0, 0.0, 0.2};
  for (int k = 0; k < 40; ++k) cycle();
  EXPECT_TRUE(all(DriveMode::kPosition));
  const Eigen::Vector3d foot = leg_->foot_in_hip_m(commanded_position());
  EXPECT_NEAR(foot.z(), -0.45 + 0.2 * 0.001, 1e-9);  // extrapolated by one cycle
  const JointVector rate = pair(out_.actuators[0].commanded_velocity_rad_s,
                                out_.actuators[1].commanded_velocity_rad_s);
  EXPECT_NEAR((leg_->jacobian(commanded_position()) * rate).z(), 0.2, 1e-9);
}

TEST_F(LegControllerTest, PositionBeginsAtTheMeasuredPoseAndGoesOverSmoothly) {
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.44};
  cycle();
  EXPECT_LT((commanded_position() - measured()).norm(), 1e-9);
  JointVector before = commanded_position();
  for (int k = 0; k < 60; ++k) {
    cycle();
    EXPECT_LT((commanded_position() - before).norm(), 6e-3);
    before = commanded_position();
  }
  EXPECT_NEAR(leg_->foot_in_hip_m(before).z(), -0.44, 1e-9);
}

TEST_F(LegControllerTest, PositionModeAsksTheLoopForWhatTheMotionTakes) {
  command_.legs[0].desired_foot_acceleration_m_s2 = {0.0, 0.0, 3.0};
  cycles(100);
  const double held_Nm = loop_torque_Nm(1);
  command_.legs[0].inertia_compensation = 1.0;
  cycles(100);
  const double armature_kg_m2 = robot_.joints[1].armature_kg_m2;
  const FootMotion foot{leg_->foot_in_hip_m(measured()), Eigen::Vector3d::Zero(),
                        Eigen::Vector3d(0.0, 0.0, 3.0)};
  const double rotor_Nm = armature_kg_m2 * joint_acceleration_rad_s2(*leg_, posed(*leg_, measured()),
                                                                     foot.acceleration_m_s2,
                                                                     pair(0.0, 0.0))[1];
  EXPECT_NEAR(loop_torque_Nm(1) - held_Nm, rotor_Nm, 0.25 * std::abs(rotor_Nm));  // and the links
  EXPECT_GT(std::abs(rotor_Nm), 2.0);
}

TEST_F(LegControllerTest, FarTargetIsApproachedNoFasterThanALimit) {
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.25};
  cycle();
  JointVector before = commanded_position();
  for (int k = 0; k < 400; ++k) {
    cycle();
    EXPECT_LT((commanded_position() - before).cwiseAbs().maxCoeff(), 3.1e-3);
    before = commanded_position();
    set_joints(before);
  }
  EXPECT_NEAR(leg_->foot_in_hip_m(before).z(), -0.25, 1e-9);
}

TEST_F(LegControllerTest, ALegThatIsTornAwayGetsSetPointsWithinReachAndThenTheDriveMayTrip) {
  cycles(100);
  const JointVector away = measured() + pair(0.0, 0.8);
  set_joints(away);
  cycle();
  const ActuatorConfig& a = robot_.actuators[1];
  const double window_rad = PositionWindow::kShare * a.torque_limit_Nm / a.position_stiffness_Nm_rad;
  ASSERT_LT(window_rad, 0.8);
  EXPECT_NEAR(commanded_position()[1], away[1] - window_rad, 1e-9);
  EXPECT_EQ(core_.limits().window, 1);
  cycles(static_cast<int>(1e3 * PositionWindow::kHold_limit_s));
  EXPECT_NEAR(commanded_position()[1], away[1] - 0.8, 1e-6);
}

TEST_F(LegControllerTest, PositionAfterComplianceBeginsWithTheTorqueThatIsThere) {
  for (const double torque_Nm : {14.0, -20.0}) {
    want(ControlMode::kCompliance);
    cycles(40);
    set_joints(measured(), torque_Nm);
    want(ControlMode::kPosition);
    cycle();
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(loop_torque_Nm(i), torque_Nm, 1e-6);
    cycles(1000);
    EXPECT_NEAR(leg_->foot_in_hip_m(commanded_position()).z(), -0.45, 1e-6);  // and that fades
  }
}

TEST_F(LegControllerTest, TorqueThatPositionBeginsWithIsSeenThroughTheBelt) {
  robot_.legs[0].transmission = {1.0, 0.0, -1.0, 1.0};
  robot_.actuators[0].position_stiffness_Nm_rad = 0.0;  // unknown: measured position as it was
  ControllerCore core(robot_, robot_.preset("paper"), robot_.watchdogs);
  for (const ControlMode mode : {ControlMode::kCompliance, ControlMode::kPosition}) {
    want(mode);
    set_joints(measured(), 10.0);
    command_.stamp = state_.stamp;
    state_.stamp = {state_.stamp.utime_us + 1000, state_.stamp.seq + 1};
    core.step(state_, &command_, out_);
  }
  const ActuatorConfig& knee = robot_.actuators[1];
  const double there_rad = measured()[1] + measured()[0];
  EXPECT_NEAR(commanded_position()[0], measured()[0], 1e-9);
  EXPECT_NEAR(knee.position_stiffness_Nm_rad * (commanded_position()[1] - there_rad) +
                  knee.position_damping_Nm_s_rad * out_.actuators[1].commanded_velocity_rad_s,
              10.0, 1e-6);
}

TEST_F(LegControllerTest, BetweenPositionAndJointsTheSetPointsGoOn) {
  command_.legs[0].desired_foot_velocity_m_s = {0.0, 0.0, 0.2};
  cycles(60);
  const JointVector before = commanded_position();
  const double rate = out_.actuators[1].commanded_velocity_rad_s;
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {measured()[0] + 0.2, measured()[1] - 0.2, 0.0};
  cycle();
  EXPECT_NEAR(commanded_position()[1], before[1] + 0.001 * rate, 1e-9);
  EXPECT_NEAR(out_.actuators[1].commanded_velocity_rad_s, rate, 1e-9);
  cycles(300);
  EXPECT_NEAR(commanded_position()[1], measured()[1] - 0.2, 1e-6);
}

TEST_F(LegControllerTest, PositionOfAMovingLegBeginsWithItsSpeed) {
  want(ControlMode::kCompliance);
  cycles(40);
  state_.joints[1].estimated_velocity_rad_s = 4.0;
  want(ControlMode::kPosition);
  cycle();
  EXPECT_NEAR(out_.actuators[1].commanded_velocity_rad_s, 4.0, 1e-6);
}

TEST_F(LegControllerTest, PositionFromIdleBeginsAtTheMeasuredPositionWhateverTheMotorShows) {
  set_joints(measured(), 14.0);
  cycle();
  EXPECT_LT((commanded_position() - measured()).norm(), 1e-9);
  want(ControlMode::kCompliance);
  cycles(40);
  for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = false;
  want(ControlMode::kPosition);
  cycles(2);
  for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = true;
  cycle();
  EXPECT_LT((commanded_position() - measured()).norm(), 1e-9);
}

TEST_F(LegControllerTest, ComplianceBeginsWithTheTorqueThatIsThere) {
  set_joints(measured(), 14.0);
  want(ControlMode::kCompliance);
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.46};
  cycle();
  EXPECT_TRUE(all(DriveMode::kTorque));
  EXPECT_NEAR(commanded_torque()[0], 14.0, 1e-9);
  EXPECT_NEAR(commanded_torque()[1], 14.0, 1e-9);
  cycles(30);
  const JointVector law = leg_->jacobian(measured()).transpose() * Eigen::Vector3d(0.0, 0.0, -62.8) +
                          leg_->gravity_torque_Nm(measured());
  EXPECT_LT((commanded_torque() - law).norm(), 1e-9);
}

TEST_F(LegControllerTest, StepOfTheSetPointIsNotSlowedOnceInCompliance) {
  want(ControlMode::kCompliance);
  cycles(40);
  const double before = commanded_torque()[1];
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.47};
  cycle();
  const double lever = leg_->jacobian(measured())(2, 1);
  EXPECT_NEAR(commanded_torque()[1] - before, lever * 6280.0 * -0.02, 1e-9);
  EXPECT_EQ(core_.limits().rate, 0);
}

TEST_F(LegControllerTest, DrivesThatAreNotEnabledGetTheMeasuredPositionOrNoTorque) {
  state_.joints[1].drive_enabled = false;
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.40};
  command_.legs[0].desired_foot_velocity_m_s = {0.0, 0.0, 1.0};
  for (int k = 0; k < 30; ++k) {
    state_.joints[1].estimated_position_rad += 0.001;
    cycle();
    EXPECT_TRUE(all(DriveMode::kPosition));
    EXPECT_LT((commanded_position() - measured()).norm(), 1e-12);
    EXPECT_EQ(out_.actuators[1].commanded_velocity_rad_s, 0.0);
  }
  want(ControlMode::kCompliance);
  cycle();
  EXPECT_EQ(commanded_torque().norm(), 0.0);
  state_.joints[1].drive_enabled = true;
  const double law_Nm = 6280.0 * 0.05 * 0.2;
  cycle();
  EXPECT_LT(commanded_torque().norm(), 0.1 * law_Nm);
}

TEST_F(LegControllerTest, PositionStaysInsideTheJointLimits) {
  robot_.joints[1].position_max_rad = 1.5;
  ControllerCore core(robot_, robot_.preset("paper"), robot_.watchdogs);
  set_joints(leg_->inverse({0.0, 0.0, -0.55}, pair(2.0, 1.0)).position_rad);
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.40};
  for (int k = 0; k < 800; ++k) {
    command_.stamp = state_.stamp;
    state_.stamp = {state_.stamp.utime_us + 1000, state_.stamp.seq + 1};
    core.step(state_, &command_, out_);
    ASSERT_LE(out_.actuators[1].commanded_position_rad, 1.5 - kPositionMargin_rad);
  }
  EXPECT_GT(core.limits().position, 0);
}

TEST_F(LegControllerTest, JointThatWasPushedBeyondItsLimitsGetsASetPointInside) {
  const double low_rad = robot_.joints[0].position_min_rad + kPositionMargin_rad;
  set_joints(pair(low_rad + 0.1, 1.0));
  command_.legs[0].desired_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(measured()));
  cycles(60);
  for (int k = 0; k < 60; ++k) {  // the world pushes the thigh up, and the desired foot goes along
    set_joints(pair(measured()[0] - 0.005, 1.0));
    command_.legs[0].desired_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(measured()));
    cycle();
    ASSERT_GE(commanded_position()[0], low_rad - 1e-9);
  }
  EXPECT_GT(core_.limits().position, 0);
}

TEST_F(LegControllerTest, JointThatBeginsBeyondItsLimitsIsBroughtInsideWithoutAKick) {
  const double low_rad = robot_.joints[0].position_min_rad + kPositionMargin_rad;
  set_joints(pair(low_rad - 0.1, 1.0));
  command_.legs[0].desired_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(measured()));
  cycle();
  EXPECT_NEAR(commanded_position()[0], low_rad - 0.1, 1e-9);
  for (int k = 0; k < 60; ++k) {
    const double before_rad = commanded_position()[0];
    cycle();
    ASSERT_GE(commanded_position()[0], before_rad - 1e-9);
    ASSERT_LT(commanded_position()[0], before_rad + 3.1e-3);
  }
  EXPECT_NEAR(commanded_position()[0], low_rad, 1e-9);
}

TEST_F(LegControllerTest, JointModeSendsTheAnglesWithTheirSpeedsAgeIncluded) {
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {measured()[0], measured()[1], kNaN};
  cycles(40);
  command_.legs[0].desired_joint_velocity_rad_s = {0.0, 0.5, 0.0};
  cycle();
  EXPECT_TRUE(all(DriveMode::kPosition));
  EXPECT_NEAR(commanded_position()[0], measured()[0], 1e-12);
  EXPECT_NEAR(commanded_position()[1], measured()[1] + 0.5e-3, 1e-12);
  EXPECT_EQ(out_.actuators[1].commanded_velocity_rad_s, 0.5);
}

TEST_F(LegControllerTest, JointModeBeginsAtTheMeasuredPoseAndGoesOverNoFasterThanALimit) {
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {measured()[0] - 0.3, measured()[1], 0.0};
  cycle();
  EXPECT_LT((commanded_position() - measured()).norm(), 1e-9);
  JointVector before = commanded_position();
  for (int k = 0; k < 400; ++k) {
    cycle();
    ASSERT_LT((commanded_position() - before).cwiseAbs().maxCoeff(), 3.1e-3);
    before = commanded_position();
  }
  EXPECT_NEAR(commanded_position()[0], measured()[0] - 0.3, 1e-9);
}

TEST_F(LegControllerTest, JointModeStaysInsideJointAndSpeedLimits) {
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {measured()[0], 2.0, 0.0};
  cycles(2000);
  set_joints(pair(measured()[0], 2.4));
  command_.legs[0].desired_joint_position_rad[1] = 7.0;
  cycles(3);
  EXPECT_NEAR(commanded_position()[1], robot_.joints[1].position_max_rad - kPositionMargin_rad, 1e-9);
  EXPECT_EQ(out_.actuators[1].commanded_velocity_rad_s, 0.0);
  command_.legs[0].desired_joint_position_rad[1] = 1.0;
  command_.legs[0].desired_joint_velocity_rad_s = {0.0, -50.0, 0.0};
  cycle();
  EXPECT_EQ(out_.actuators[1].commanded_velocity_rad_s, -robot_.actuators[1].speed_limit_rad_s);
  EXPECT_GT(core_.limits().velocity, 0);
}

TEST_F(LegControllerTest, JointModeWithoutEveryAngleIsDamping) {
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {1.0, kNaN, 0.0};
  cycle();
  EXPECT_EQ(core_.basis(), CommandBasis::kNotFinite);
  EXPECT_TRUE(all(DriveMode::kDamping));
}

TEST_F(LegControllerTest, JointModeGoesThroughTheBelt) {
  robot_.legs[0].transmission = {1.0, 0.0, -1.0, 1.0};
  ControllerCore core(robot_, robot_.preset("paper"), robot_.watchdogs);
  want(ControlMode::kJoint);
  command_.legs[0].desired_joint_position_rad = {measured()[0], measured()[1], 0.0};
  command_.legs[0].desired_joint_velocity_rad_s = {0.5, 0.0, 0.0};
  for (int k = 0; k < 60; ++k) {
    command_.stamp = state_.stamp;
    state_.stamp = {state_.stamp.utime_us + 1000, state_.stamp.seq + 1};
    core.step(state_, &command_, out_);
  }
  EXPECT_NEAR(commanded_position()[1], measured()[1] + measured()[0] + 0.5e-3, 1e-9);
  EXPECT_NEAR(out_.actuators[1].commanded_velocity_rad_s, 0.5, 1e-12);
}

TEST_F(LegControllerTest, LegWithoutKinematicsFollowsJointsAndNoFoot) {
  robot_.legs[0].kinematics = kNoKinematics;
  ControllerCore core(robot_, robot_.preset("paper"), robot_.watchdogs);
  for (const ControlMode mode : {ControlMode::kPosition, ControlMode::kJoint}) {
    want(mode);
    command_.legs[0].desired_joint_position_rad = {measured()[0], measured()[1], 0.0};
    command_.stamp = state_.stamp;
    state_.stamp = {state_.stamp.utime_us + 1000, state_.stamp.seq + 1};
    core.step(state_, &command_, out_);
    const bool joint = mode == ControlMode::kJoint;
    EXPECT_EQ(core.basis(), joint ? CommandBasis::kCommanded : CommandBasis::kUnreachable);
    EXPECT_TRUE(all(joint ? DriveMode::kPosition : DriveMode::kDamping));
  }
}

TEST_F(LegControllerTest, TorqueAndSoftStopLimitsActLastAndAreCounted) {
  want(ControlMode::kCompliance);
  cycles(40);
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.60};
  command_.legs[0].stiffness_N_m = {90000.0, 0.0, 90000.0};
  cycles(5);
  EXPECT_NEAR(std::abs(commanded_torque()[1]), robot_.actuators[1].torque_limit_Nm, 1e-9);
  EXPECT_GT(core_.limits().torque, 0);
  EXPECT_GT(core_.limits().rate, 0);
  EXPECT_EQ(core_.limits().soft_stop, 0);
  set_joints(pair(1.7, 0.06));
  cycle();
  EXPECT_GT(core_.limits().soft_stop, 0);
}

TEST_F(LegControllerTest, BeltLegGetsActuatorSetPoints) {
  robot_.legs[0].transmission = {1.0, 0.0, 0.01, 1.0};
  ControllerCore core(robot_, robot_.preset("paper"), robot_.watchdogs);
  command_.stamp = {state_.stamp.utime_us - 1000, state_.stamp.seq - 1};
  core.step(state_, &command_, out_);
  EXPECT_NEAR(out_.actuators[1].commanded_position_rad, measured()[1] - 0.01 * measured()[0], 1e-9);
}

TEST_F(LegControllerTest, AFreeFootThatStaysStuckIsHelpedAndOneInStanceIsNot) {
  want(ControlMode::kCompliance);
  command_.legs[0].friction_compensation = 0.9;
  command_.legs[0].stiffness_N_m = {2000.0, 0.0, 2000.0};
  command_.legs[0].desired_foot_in_hip_m[2] += 0.004;  // 8 N, which friction holds
  const auto grown_Nm = [&](LegPhase phase) {
    command_.legs[0].phase = phase;
    ControllerCore core(robot_, robot_.preset("best"), robot_.watchdogs);
    JointVector first_Nm;
    for (int k = 0; k < 500; ++k) {
      command_.stamp = state_.stamp;
      state_.stamp.utime_us += 1000;
      ++state_.stamp.seq;
      core.step(state_, &command_, out_);
      if (k == 99) first_Nm = commanded_torque();  // what it began with has faded
    }
    return (commanded_torque() - first_Nm).norm();
  };
  EXPECT_GT(grown_Nm(LegPhase::kStand), 1.0);
  EXPECT_LT(grown_Nm(LegPhase::kStance), 0.01);
}

TEST_F(LegControllerTest, WhatWasLearntIsCompensatedAndInMotionLessOfAJointThatItsModelDoesNotFit) {
  want(ControlMode::kCompliance);
  command_.legs[0].friction_compensation = 0.8;
  state_.joints[1].estimated_velocity_rad_s = 1.5;
  PresetConfig preset = robot_.preset("best");
  preset.rest_friction = {0.02, 0.1};
  const auto knee_Nm = [&](double dry_factor, bool fits, double ratio) {
    ControllerCore core(robot_, preset, robot_.watchdogs);
    state_.joints[1].dry_friction_factor = dry_factor;
    state_.joints[1].model_fits = fits;
    state_.joints[1].misfit_ratio = ratio;
    for (int k = 0; k < 300; ++k) {
      command_.stamp = state_.stamp;
      state_.stamp.utime_us += 1000;
      ++state_.stamp.seq;
      core.step(state_, &command_, out_);
    }
    return commanded_torque()[1];
  };
  const double none_Nm = [&] {
    command_.legs[0].friction_compensation = 0.0;
    const double out = knee_Nm(1.0, true, 0.0);
    command_.legs[0].friction_compensation = 0.8;
    return out;
  }();
  const double all_Nm = knee_Nm(1.0, true, 0.0) - none_Nm;
  ASSERT_GT(all_Nm, 3.0);
  EXPECT_NEAR(knee_Nm(0.7, true, 0.0) - none_Nm, 0.7 * all_Nm, 1e-9);
  const double stated = robot_.joints[1].uncertainty.friction;
  EXPECT_NEAR(knee_Nm(1.0, false, 4.0) - none_Nm, (1.0 - 4.0 * stated) / 0.8 * all_Nm, 1e-9);
  EXPECT_NEAR(knee_Nm(1.0, false, 0.0) - none_Nm, (1.0 - kMisfitRatio * stated) / 0.8 * all_Nm, 1e-9);
  EXPECT_NEAR(knee_Nm(1.0, false, 100.0) - none_Nm, 0.0, 1e-9);
}

}  // namespace
}  // namespace sprung
