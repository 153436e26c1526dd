#include "estimator/estimator_core.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

constexpr double kTorquePerAmpere = 4.4;

class EstimatorCoreTest : public testing::Test {
 protected:
  EstimatorCoreTest() { set_pose({1.9, 1.2}, {0.0, 0.0}); }

  void set_pose(std::array<double, 2> position_rad, std::array<double, 2> torque_Nm) {
    for (std::size_t i = 0; i < 2; ++i) {
      ActuatorState& a = drives_.actuators[i];
      a.measured_position_rad = position_rad[i];
      a.measured_current_A = torque_Nm[i] / kTorquePerAmpere;
      a.power_state = PowerState::kOperationEnabled;
      a.shown_mode = DriveMode::kPosition;
      a.referenced = true;
    }
    drives_.safety = SafetyLevel::kOperational;
  }
  /// Motor torque that balances a force of the ground on the foot and the leg's weight.
  std::array<double, 2> balance(std::array<double, 2> position_rad, const Eigen::Vector3d& force_N) {
    const auto leg = make_leg_kinematics(robot_.legs[0]);
    JointVector q(2);
    q << position_rad[0], position_rad[1];
    const JointVector torque = leg->gravity_torque_Nm(q) - leg->jacobian(q).transpose() * force_N;
    return {torque[0], torque[1]};
  }
  const JointState& cycle() {
    ++drives_.stamp.seq;
    drives_.stamp.utime_us += 1000;
    core_.step(drives_, out_);
    return out_;
  }
  const JointState& cycles(int n) {
    for (int k = 0; k < n; ++k) cycle();
    return out_;
  }

  RobotConfig robot_ = load_robot("single_leg");
  EstimatorCore core_{robot_};
  DriveState drives_{2};
  JointState out_{2, 1};
};

TEST_F(EstimatorCoreTest, GroundForceIsFoundWithItsSign) {
  const Eigen::Vector3d force(-8.0, 0.0, 120.0);
  set_pose({2.4, 1.6}, balance({2.4, 1.6}, force));
  cycles(50);
  EXPECT_NEAR(out_.legs[0].foot_force_N[0], force.x(), 0.1);
  EXPECT_NEAR(out_.legs[0].foot_force_N[2], force.z(), 0.1);
  EXPECT_TRUE(out_.legs[0].contact);
  EXPECT_GT(out_.legs[0].contact_confidence, 0.9);
}

TEST_F(EstimatorCoreTest, ForceThatAStuckGearCouldHoldIsNoContactYet) {
  set_pose({2.4, 1.6}, balance({2.4, 1.6}, {0.0, 0.0, 35.0}));
  cycles(50);
  EXPECT_NEAR(out_.legs[0].foot_force_N[2], 35.0, 0.1);
  EXPECT_FALSE(out_.legs[0].contact);
  EXPECT_GT(out_.legs[0].contact_confidence, 0.5);
  EXPECT_LT(out_.legs[0].contact_confidence, 0.99);
}

TEST_F(EstimatorCoreTest, ExternalTorqueIsTheOutsideWorldsOnTheJoint) {
  // The ground pushes the foot up: the knee is driven toward flexion.
  set_pose({2.4, 1.6}, balance({2.4, 1.6}, {0.0, 0.0, 51.0}));
  cycles(50);
  EXPECT_GT(out_.joints[1].external_torque_Nm, 1.0);
}

TEST_F(EstimatorCoreTest, HangingLegHasNoContact) {
  set_pose({2.0, 1.0}, balance({2.0, 1.0}, Eigen::Vector3d::Zero()));
  cycles(50);
  EXPECT_FALSE(out_.legs[0].contact);
  EXPECT_NEAR(out_.legs[0].foot_force_N[2], 0.0, 0.1);
}

TEST_F(EstimatorCoreTest, FootAndItsVelocityFollowTheJoints) {
  for (int k = 0; k < 200; ++k) {
    set_pose({1.9, 1.2 + 0.4e-3 * k}, {0.0, robot_.joints[1].coulomb_friction_Nm});
    cycle();
  }
  const auto leg = make_leg_kinematics(robot_.legs[0]);
  JointVector q(2), w(2);
  q << 1.9, 1.2 + 0.4e-3 * 199;
  w << 0.0, 0.4;
  EXPECT_LT((to_eigen(out_.legs[0].estimated_foot_in_hip_m) - leg->foot_in_hip_m(q)).norm(), 1e-6);
  EXPECT_LT((to_eigen(out_.legs[0].estimated_foot_velocity_m_s) - leg->jacobian(q) * w).norm(), 1e-3);
}

TEST_F(EstimatorCoreTest, CarriesStampAndSafety) {
  drives_.safety = SafetyLevel::kQuickStop;
  cycles(3);
  EXPECT_EQ(out_.stamp.seq, 2);
  EXPECT_EQ(out_.stamp.utime_us, 3000);
  EXPECT_EQ(out_.used_drive_state_seq, 2);
  EXPECT_EQ(out_.safety, SafetyLevel::kQuickStop);
}

/// A replay must give the estimator the sample that it had.
TEST(EstimatorCoreWithImu, SaysWhichSampleItUsed) {
  const RobotConfig robot = load_robot("pegasus");
  EstimatorCore core(robot);
  DriveState in(robot.actuators.size());
  JointState out(robot.joints.size(), robot.legs.size());
  in.stamp = {2000, 7};
  core.step(in, out);
  EXPECT_EQ(out.used_imu_seq, -1);
  Imu imu;
  imu.stamp = {2000, 5};
  imu.status = ImuStatus::kNoAttitude;
  in.stamp = {4000, 8};
  core.step(in, out, &imu);
  EXPECT_EQ(out.used_imu_seq, 5);
  imu.stamp.seq = 9;
  imu.status = ImuStatus::kStarting;  // says nothing
  in.stamp = {6000, 9};
  core.step(in, out, &imu);
  EXPECT_EQ(out.used_imu_seq, 5);
}

TEST_F(EstimatorCoreTest, RobotWithoutAnImuUsesNoSample) {
  Imu imu;
  imu.stamp = {2000, 1};
  core_.step(drives_, out_, &imu);
  EXPECT_EQ(out_.used_imu_seq, -1);
}

TEST_F(EstimatorCoreTest, OneSilentDriveLeavesTheForceUnknownAndTheOtherJointKnown) {
  cycles(50);
  drives_.actuators[1].measured_current_A = kNaN;
  cycles(robot_.watchdogs.silent_cycles + 1);
  EXPECT_EQ(out_.joints[0].status, JointStatus::kOk);
  EXPECT_EQ(out_.joints[1].status, JointStatus::kStale);
  EXPECT_TRUE(std::isnan(out_.joints[1].gear_output_torque_Nm));
  EXPECT_TRUE(std::isnan(out_.legs[0].foot_force_N[2]));
  EXPECT_FALSE(out_.legs[0].contact);
}

TEST_F(EstimatorCoreTest, HowLongIsSilentComesFromTheGivenWatchdogs) {
  EstimatorCore patient(robot_, robot_.simulation_watchdogs);
  for (int k = 0; k < 80; ++k) {
    ++drives_.stamp.seq;
    drives_.stamp.utime_us += 1000;
    drives_.actuators[1].age_cycles = k < 20 ? 0 : k - 19;
    patient.step(drives_, out_);
    const bool stale = out_.joints[1].status == JointStatus::kStale;
    ASSERT_EQ(stale, k >= 20 + robot_.simulation_watchdogs.silent_cycles) << k;
  }
}

TEST_F(EstimatorCoreTest, RepeatedCycleGivesTheSameAnswer) {
  cycles(5);
  set_pose({1.9, 1.21}, {3.0, 4.0});
  const JointState first = cycle();
  core_.step(drives_, out_);
  EXPECT_EQ(first.joints[1].estimated_velocity_rad_s, out_.joints[1].estimated_velocity_rad_s);
  EXPECT_EQ(first.stamp.seq, out_.stamp.seq);
}

TEST_F(EstimatorCoreTest, RestartAndGapBeginAnewInsteadOfJumping) {
  cycles(50);
  drives_.stamp.seq = 0;
  set_pose({2.5, 1.0}, {0.0, 0.0});
  core_.step(drives_, out_);
  EXPECT_EQ(out_.joints[0].status, JointStatus::kStarting);
  EXPECT_EQ(out_.joints[0].estimated_velocity_rad_s, 0.0);
  cycles(50);
  drives_.stamp.utime_us += 50000;
  set_pose({1.5, 1.5}, {0.0, 0.0});
  cycle();
  EXPECT_EQ(out_.joints[0].status, JointStatus::kStarting);
  EXPECT_DOUBLE_EQ(out_.joints[0].estimated_position_rad, 1.5);
}

TEST_F(EstimatorCoreTest, HowLongAGapIsBridgedComesFromTheGivenWatchdogs) {
  const double longest_s = robot_.simulation_watchdogs.joint_state_s;
  ASSERT_GT(longest_s, robot_.watchdogs.joint_state_s);
  EstimatorCore patient(robot_, robot_.simulation_watchdogs);
  const auto step_after = [&](std::int64_t gap_us) {
    ++drives_.stamp.seq;
    drives_.stamp.utime_us += gap_us;
    patient.step(drives_, out_);
    return out_.joints[0].status;
  };
  for (int k = 0; k < 50; ++k) step_after(1000);
  EXPECT_EQ(step_after(std::llround(longest_s * 1e6)), JointStatus::kOk);
  EXPECT_EQ(step_after(std::llround(longest_s * 1e6) + 1), JointStatus::kStarting);
}

TEST_F(EstimatorCoreTest, StateOfAnotherRobotIsNotUsed) {
  cycles(50);
  const DriveState other(3);
  core_.step(other, out_);
  EXPECT_EQ(out_.stamp.seq, 49);
}

TEST_F(EstimatorCoreTest, SameInputsGiveTheSameBitsAndNothingIsAllocated) {
  EstimatorCore twin(robot_);
  JointState twin_out(2, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const double value = noise(random);
    set_pose({1.9 + 0.01 * value, 1.2}, {20.0 * value, k % 97 == 0 ? kNaN : 5.0});
    const std::int64_t before = test::allocation_count();
    cycle();
    ASSERT_EQ(test::allocation_count(), before);
    twin.step(drives_, twin_out);
    for (std::size_t j = 0; j < 2; ++j) {
      ASSERT_EQ(std::memcmp(&out_.joints[j].estimated_position_rad,
                            &twin_out.joints[j].estimated_position_rad, 8 * sizeof(double)),
                0);
    }
  }
}

TEST(EstimatorWithoutFeet, EstimatesJointsAndKnowsNoFoot) {
  RobotConfig robot = load_robot("pegasus");
  for (LegConfig& leg : robot.legs) leg.kinematics = kNoKinematics;
  EstimatorCore core(robot);
  DriveState drives(12);
  JointState out(12, 4);
  for (std::size_t i = 0; i < 12; ++i) {
    ActuatorState& a = drives.actuators[i];
    a.measured_position_rad = 0.1 * static_cast<double>(i);
    a.measured_current_A = 1.0;
    a.referenced = true;
  }
  for (int k = 0; k < 50; ++k) {
    drives.stamp = {2000 * k, k};
    core.step(drives, out);
  }
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(out.joints[i].status, JointStatus::kOk) << i;
    EXPECT_NEAR(out.joints[i].estimated_position_rad, 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(out.joints[i].motor_side_torque_Nm + out.joints[i].friction_torque_Nm, 10.85, 1e-9);
    EXPECT_TRUE(std::isnan(out.joints[i].external_torque_Nm));
  }
  for (const EstimatedLeg& leg : out.legs) {
    EXPECT_TRUE(std::isnan(leg.estimated_foot_in_hip_m[0]));
    EXPECT_FALSE(leg.contact);
  }
}

TEST_F(EstimatorCoreTest, RobotWithoutABodySaysNothingOfOne) {
  Imu imu;
  imu.status = ImuStatus::kGood;
  imu.stamp.seq = 1;
  imu.measured_angular_velocity_rad_s = imu.measured_specific_force_m_s2 = {0, 0, 9.81};
  imu.measured_quaternion_wxyz = {1, 0, 0, 0};
  drives_.stamp.seq = 0;
  core_.step(drives_, out_, &imu);
  EXPECT_TRUE(std::isnan(out_.body.estimated_quaternion_wxyz[0]));
  EXPECT_FALSE(out_.body.uses_imu);
  BodyState left_alone;
  left_alone.slips = 3;
  EXPECT_FALSE(core_.body_state(left_alone));
  EXPECT_EQ(left_alone.slips, 3);
}

TEST(EstimatorCoreWithABody, BodyStateIsOfTheNewestCycleAndKnowsNoPlaceBeforeAFootStood) {
  const RobotConfig robot = load_robot("pegasus");
  EstimatorCore core(robot);
  DriveState drives(robot.actuators.size());
  JointState out(robot.joints.size(), robot.legs.size());
  drives.stamp = {12000, 6};
  core.step(drives, out, nullptr);
  BodyState state;
  ASSERT_TRUE(core.body_state(state));
  EXPECT_EQ(state.stamp.seq, 6);
  EXPECT_EQ(state.stamp.utime_us, 12000);
  EXPECT_TRUE(std::isnan(state.estimated_position_in_world_m[0]));
  EXPECT_FALSE(state.uses_imu);
}

/// And the answer to a repeated cycle is the same again, whatever the IMU says by then.
TEST(EstimatorCoreWithABody, TakesTheImuOfItsCycle) {
  RobotConfig robot = load_robot("pegasus");
  robot.body.imu_latency_s = 0.0;
  EstimatorCore core(robot);
  DriveState drives(robot.actuators.size());
  JointState out(robot.joints.size(), robot.legs.size());
  Imu imu;
  imu.status = ImuStatus::kGood;
  imu.measured_angular_velocity_rad_s = {0.1, 0.2, 0.3};
  imu.measured_specific_force_m_s2 = {0, 0, 9.81};
  imu.measured_quaternion_wxyz = {std::cos(0.1), std::sin(0.1), 0, 0};
  imu.stamp.seq = drives.stamp.seq = 0;
  core.step(drives, out, &imu);
  EXPECT_TRUE(out.body.uses_imu);
  EXPECT_NEAR(out.body.estimated_quaternion_wxyz[1], std::sin(0.1), 1e-12);
  EXPECT_EQ(out.body.estimated_angular_velocity_rad_s[2], 0.3);
  core.step(drives, out, nullptr);
  EXPECT_TRUE(out.body.uses_imu);
  drives.stamp.seq = 6;
  drives.stamp.utime_us = 12000;
  core.step(drives, out, nullptr);
  EXPECT_FALSE(out.body.uses_imu);
  EXPECT_NEAR(out.body.estimated_quaternion_wxyz[1], std::sin(0.1), 0.01);
}

}  // namespace
}  // namespace sprung
