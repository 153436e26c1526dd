/// The leg controller on four three-joint legs: feet go where they are wanted, and are held by springs, on
/// both sides.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "controller/controller_core.h"
#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "tests/model/pegasus_leg.h"

namespace sprung {
namespace {

/// Pegasus as shipped, but for its legs, which have none of their own yet, and a preset of another robot.
RobotConfig pegasus_on_its_legs() {
  RobotConfig robot = load_robot("pegasus");
  for (LegConfig& leg : robot.legs) {
    const LegConfig three = test::pegasus_leg(leg.name[1] == 'l' ? LegSide::kLeft : LegSide::kRight);
    leg.kinematics = three.kinematics;
    leg.side = three.side;
    leg.links = three.links;
  }
  robot.presets = load_robot("single_leg").presets;
  return robot;
}

double left(const LegConfig& leg) { return leg.side == LegSide::kLeft ? 1.0 : -1.0; }

class ThreeJointControlTest : public testing::Test {
 protected:
  ThreeJointControlTest() {
    state_.safety = SafetyLevel::kOperational;
    state_.stamp = {100000, 100};
    JointVector near(3);
    near << 0.0, 2.0, 1.0;
    for (std::size_t i = 0; i < 4; ++i) {
      legs_.push_back(make_leg_kinematics(robot_.legs[i]));
      const Eigen::Vector3d foot(0.0, 0.08 * left(robot_.legs[i]), -0.5);
      measured_ = legs_[i]->inverse(foot, near).position_rad;
      for (std::size_t j = 0; j < 3; ++j) set_joint(3 * i + j, measured_[static_cast<int>(j)]);
      command_.legs[i].desired_foot_in_hip_m = to_vec3(foot + wanted_step(i));
      command_.legs[i].stiffness_N_m = {625.0, 1000.0, 3000.0};
    }
  }
  void set_joint(std::size_t place, double position_rad) {
    EstimatedJoint& joint = state_.joints[place];
    joint.estimated_position_rad = position_rad;
    joint.estimated_velocity_rad_s = 0.0;
    joint.measured_motor_torque_Nm = 0.0;
    joint.friction_torque_Nm = 0.0;
    joint.status = JointStatus::kOk;
    joint.drive_enabled = true;
  }
  /// Forward, outward and up, the same of all legs but for the mirror.
  Eigen::Vector3d wanted_step(std::size_t leg) const { return {0.01, 0.02 * left(robot_.legs[leg]), 0.015}; }

  /// Long enough for every blend and ramp to be over.
  void run(ControlMode mode) {
    for (DesiredLeg& leg : command_.legs) leg.control_mode = mode;
    for (int k = 0; k < 1000; ++k) {
      command_.stamp = state_.stamp;
      state_.stamp.utime_us += 2000;
      ++state_.stamp.seq;
      core_.step(state_, &command_, out_);
    }
  }

  RobotConfig robot_ = pegasus_on_its_legs();
  std::vector<std::unique_ptr<LegKinematics>> legs_;
  ControllerCore core_{robot_, robot_.preset("paper"), robot_.watchdogs};
  JointState state_{12, 4};
  LegCommand command_{4};
  DriveCommand out_{12};
  JointVector measured_;
};

TEST_F(ThreeJointControlTest, PositionControlBringsEveryFootWhereItIsWanted) {
  run(ControlMode::kPosition);
  for (std::size_t i = 0; i < 4; ++i) {
    JointVector commanded(3);
    for (int j = 0; j < 3; ++j) {
      const ActuatorCommand& a = out_.actuators[3 * i + static_cast<std::size_t>(j)];
      ASSERT_EQ(a.mode, DriveMode::kPosition) << robot_.legs[i].name;
      commanded[j] = a.commanded_position_rad;
    }
    const Eigen::Vector3d foot = legs_[i]->foot_in_hip_m(commanded);
    EXPECT_LT((foot - to_eigen(command_.legs[i].desired_foot_in_hip_m)).norm(), 1e-9) << robot_.legs[i].name;
  }
}

TEST_F(ThreeJointControlTest, ComplianceIsASpringAtTheFootAndHoldsTheLegsWeight) {
  run(ControlMode::kCompliance);
  for (std::size_t i = 0; i < 4; ++i) {
    JointVector q(3), torque(3);
    for (int j = 0; j < 3; ++j) {
      const std::size_t place = 3 * i + static_cast<std::size_t>(j);
      q[j] = state_.joints[place].estimated_position_rad;
      ASSERT_EQ(out_.actuators[place].mode, DriveMode::kTorque) << robot_.legs[i].name;
      torque[j] = out_.actuators[place].commanded_torque_Nm;
    }
    const Eigen::Vector3d force_N = Eigen::Vector3d(625, 1000, 3000).cwiseProduct(wanted_step(i));
    const JointVector expected = legs_[i]->jacobian(q).transpose() * force_N + legs_[i]->gravity_torque_Nm(q);
    EXPECT_LT((torque - expected).norm(), 1e-6) << robot_.legs[i].name << ": " << torque.transpose();
    EXPECT_GT(std::abs(torque[0]), 1.0);
  }
  // The right leg's abduction the other way round, hip and knee the same.
  EXPECT_NEAR(out_.actuators[0].commanded_torque_Nm, -out_.actuators[3].commanded_torque_Nm, 1e-9);
  EXPECT_NEAR(out_.actuators[2].commanded_torque_Nm, out_.actuators[5].commanded_torque_Nm, 1e-9);
}

}  // namespace
}  // namespace sprung
