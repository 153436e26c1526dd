#pragma once
/// A controller with a standing leg's joint state and a leg command that holds its foot.
#include <gtest/gtest.h>

#include "controller/controller_core.h"
#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "signals/drive_command.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"

namespace sprung {

class ControllerFixture : public testing::Test {
 protected:
  ControllerFixture() {
    state_.safety = SafetyLevel::kOperational;
    state_.stamp = {100000, 100};
    set_joints(leg_->inverse({0.0, 0.0, -0.45}, pair(2.0, 1.0)).position_rad);
    state_.legs[0].estimated_foot_in_hip_m = {0.0, 0.0, -0.45};
    command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.45};
    want(ControlMode::kPosition);
  }

  static JointVector pair(double a, double b) {
    JointVector v(2);
    v << a, b;
    return v;
  }
  void set_joints(const JointVector& position_rad, double motor_torque_Nm = 0.0) {
    for (std::size_t j = 0; j < 2; ++j) {
      EstimatedJoint& joint = state_.joints[j];
      joint.estimated_position_rad = position_rad[static_cast<int>(j)];
      joint.estimated_velocity_rad_s = 0.0;
      joint.measured_motor_torque_Nm = motor_torque_Nm;
      joint.friction_torque_Nm = 0.0;
      joint.status = JointStatus::kOk;
      joint.drive_enabled = true;
    }
  }
  void want(ControlMode mode) {
    DesiredLeg& leg = command_.legs[0];
    leg.control_mode = mode;
    leg.stiffness_N_m = {9000.0, 0.0, 6280.0};
    leg.damping_N_s_m = {200.0, 0.0, 400.0};
  }
  JointVector measured() const {
    return pair(state_.joints[0].estimated_position_rad, state_.joints[1].estimated_position_rad);
  }
  JointVector commanded_position() const {
    return pair(out_.actuators[0].commanded_position_rad, out_.actuators[1].commanded_position_rad);
  }
  /// What the drive's position loop gives.
  double loop_torque_Nm(int i) const {
    const auto place = static_cast<std::size_t>(i);
    const ActuatorConfig& a = robot_.actuators[place];
    const EstimatedJoint& joint = state_.joints[place];
    return a.position_stiffness_Nm_rad * (commanded_position()[i] - joint.estimated_position_rad) +
           a.position_damping_Nm_s_rad *
               (out_.actuators[place].commanded_velocity_rad_s - joint.estimated_velocity_rad_s);
  }
  JointVector commanded_torque() const {
    return pair(out_.actuators[0].commanded_torque_Nm, out_.actuators[1].commanded_torque_Nm);
  }
  /// One cycle with a command of the cycle before.
  const DriveCommand& cycle() {
    command_.stamp = state_.stamp;
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    core_.step(state_, &command_, out_);
    return out_;
  }
  const DriveCommand& cycles(int n) {
    for (int k = 0; k < n; ++k) cycle();
    return out_;
  }
  testing::AssertionResult all(DriveMode mode) const {
    for (const ActuatorCommand& a : out_.actuators) {
      if (a.mode != mode) return testing::AssertionFailure() << name(a.mode) << " instead of " << name(mode);
    }
    return testing::AssertionSuccess();
  }

  RobotConfig robot_ = load_robot("single_leg");
  std::unique_ptr<LegKinematics> leg_ = make_leg_kinematics(robot_.legs[0]);
  ControllerCore core_{robot_, robot_.preset("paper"), robot_.watchdogs};
  JointState state_{2, 1};
  LegCommand command_{1};
  DriveCommand out_{2};
};

}  // namespace sprung
