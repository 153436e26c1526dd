/// Planner and controller closed over an ideal leg: joints that follow position set-points exactly, and
/// drives that take 100 ms to enable. No plant: only that the two cores agree on modes, poses and times.
#include <gtest/gtest.h>

#include <cmath>

#include "controller/controller_core.h"
#include "model/leg_kinematics.h"
#include "planner/planner_core.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

class IdealLeg : public testing::Test {
 protected:
  IdealLeg() {
    state_.safety = SafetyLevel::kOperational;
    position_.resize(2);
    position_ << 2.7, 2.3;
    for (EstimatedJoint& joint : state_.joints) joint.status = JointStatus::kOk;
    sense();
  }
  void sense() {
    for (std::size_t j = 0; j < 2; ++j) {
      EstimatedJoint& joint = state_.joints[j];
      joint.estimated_position_rad = position_[static_cast<int>(j)];
      joint.estimated_velocity_rad_s = joint.measured_motor_torque_Nm = joint.friction_torque_Nm = 0.0;
      joint.drive_enabled = enabling_cycles_ >= 100;
    }
    state_.legs[0].estimated_foot_in_hip_m = to_vec3(kinematics_->foot_in_hip_m(position_));
  }
  /// In the order of design section 3: the controller uses the planner's command of the cycle before.
  void cycle() {
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    sense();
    controller_.step(state_, previous_.stamp.seq >= 0 ? &previous_ : nullptr, drives_);
    planner_.step(state_, legs_, motion_);
    previous_ = legs_;
    const bool wanted = drives_.actuators[0].mode == DriveMode::kPosition;
    enabling_cycles_ = wanted ? enabling_cycles_ + 1 : 0;
    for (std::size_t i = 0; i < 2 && wanted; ++i) {
      const double target = drives_.actuators[i].commanded_position_rad;
      const double step = std::abs(target - position_[static_cast<int>(i)]);
      largest_step_rad_ = std::max(largest_step_rad_, step);
      position_[static_cast<int>(i)] = target;
    }
  }
  bool run_until(MotionPhase phase) {
    for (int k = 0; k < 5000 && motion_.state != phase; ++k) cycle();
    return motion_.state == phase;
  }
  void send(OperatorKind kind) {
    OperatorCommand command;
    command.kind = kind;
    command.request_id = ++last_id_;
    command.jump_mode = JumpMode::kPosition;
    planner_.submit(command);
  }
  double foot_height_m() const { return kinematics_->foot_in_hip_m(position_).z(); }

  RobotConfig robot_ = load_robot("single_leg");
  PresetConfig preset_ = robot_.preset("best");
  std::unique_ptr<LegKinematics> kinematics_ = make_leg_kinematics(robot_.legs[0]);
  ControllerCore controller_{robot_, preset_, robot_.watchdogs};
  PlannerCore planner_{robot_, preset_};
  JointState state_{2, 1};
  LegCommand legs_{1}, previous_{1};
  DriveCommand drives_{2};
  MotionState motion_{1};
  JointVector position_;
  double largest_step_rad_ = 0.0;
  int enabling_cycles_ = 0;
  std::int64_t last_id_ = 0;
};

TEST_F(IdealLeg, StandsUpJumpsAndSitsDown) {
  cycle();
  EXPECT_EQ(drives_.actuators[0].mode, DriveMode::kDisabled);
  send(OperatorKind::kStand);
  ASSERT_TRUE(run_until(MotionPhase::kStanding));
  for (int k = 0; k < 10; ++k) cycle();
  EXPECT_NEAR(foot_height_m(), -preset_.stand_length_m, 1e-6);
  EXPECT_LT(largest_step_rad_, 5e-3);

  state_.legs[0].contact = true;
  send(OperatorKind::kJump);
  ASSERT_TRUE(run_until(MotionPhase::kThrust));
  EXPECT_NEAR(foot_height_m(), -preset_.jump_curve.lengths_m.front(), 1e-3);
  for (int k = 0; k < 110; ++k) cycle();
  EXPECT_LT(foot_height_m(), -0.5);  // extended
  state_.legs[0].contact = false;
  ASSERT_TRUE(run_until(MotionPhase::kFlight));
  for (int k = 0; k < 300; ++k) cycle();
  EXPECT_NEAR(foot_height_m(), -preset_.landing_length_m, 1e-6);
  state_.legs[0].contact = true;
  ASSERT_TRUE(run_until(MotionPhase::kLanding));
  ASSERT_TRUE(run_until(MotionPhase::kStanding));
  EXPECT_EQ(motion_.jumps_done, 1);
  EXPECT_LT(largest_step_rad_, 0.03);  // the curve's own starting speed
  EXPECT_EQ(controller_.basis(), CommandBasis::kCommanded);
  EXPECT_EQ(controller_.limits().position, 0);

  send(OperatorKind::kSit);
  ASSERT_TRUE(run_until(MotionPhase::kIdle));
  for (int k = 0; k < 2; ++k) cycle();
  EXPECT_NEAR(foot_height_m(), -preset_.sit_length_m, 1e-3);
  EXPECT_EQ(drives_.actuators[1].mode, DriveMode::kDisabled);
}

}  // namespace
}  // namespace sprung
