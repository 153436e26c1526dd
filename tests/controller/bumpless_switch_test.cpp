/// No switch of a leg's control may step a drive's torque by more than 5 % of its limit: seeded random states
/// and sequences of switches, measured as what the drives would give.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/controller/controller_fixture.h"

namespace sprung {
namespace {

constexpr double kLargestStep = 0.05;

/// Position loop or torque loop of a drive that follows at once, within its limit.
double drive_torque_Nm(const ActuatorConfig& a, const ActuatorCommand& command, const EstimatedJoint& joint) {
  if (!joint.drive_enabled) return 0.0;
  double torque_Nm = 0.0;
  if (command.mode == DriveMode::kTorque) torque_Nm = command.commanded_torque_Nm;
  if (command.mode == DriveMode::kDamping)
    torque_Nm = -command.commanded_damping_Nm_s_rad * joint.estimated_velocity_rad_s;
  if (command.mode == DriveMode::kPosition)
    torque_Nm = a.position_stiffness_Nm_rad *
                    (command.commanded_position_rad - joint.estimated_position_rad) +
                a.position_damping_Nm_s_rad *
                    (command.commanded_velocity_rad_s - joint.estimated_velocity_rad_s);
  return std::clamp(torque_Nm, -a.torque_limit_Nm, a.torque_limit_Nm);
}

class BumplessSwitchTest : public ControllerFixture, public testing::WithParamInterface<int> {
 protected:
  BumplessSwitchTest() : random_(static_cast<unsigned>(GetParam())) {
    PresetConfig preset = robot_.preset("best");
    preset.rest_friction = {0.02, 0.1};
    preset.stiffness_ramp_s = 0.05;
    controller_ = std::make_unique<ControllerCore>(robot_, preset, robot_.watchdogs);
    want(ControlMode::kPosition);
    gains(2000.0, 50.0);
  }

  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// A pose and, some 0.1 rad beside it, where foot and joints are wanted.
  void pose(const JointVector& position_rad, double speed_rad_s) {
    set_joints(position_rad);
    for (EstimatedJoint& joint : state_.joints)
      joint.estimated_velocity_rad_s = draw(-speed_rad_s, speed_rad_s);
    const auto beside = [&] {
      JointVector q = position_rad;
      for (int j = 0; j < q.size(); ++j) {
        const JointConfig& c = robot_.joints[j];
        q[j] = std::clamp(q[j] + draw(-0.1, 0.1), c.position_min_rad + 0.03, c.position_max_rad - 0.03);
      }
      return q;
    };
    DesiredLeg& leg = command_.legs[0];
    leg.desired_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(beside()));
    leg.desired_foot_velocity_m_s = {draw(-0.3, 0.3), 0.0, draw(-0.3, 0.3)};
    leg.desired_foot_acceleration_m_s2 = {draw(-5.0, 5.0), 0.0, draw(-5.0, 5.0)};
    const JointVector q = beside();
    leg.desired_joint_position_rad = {q[0], q[1], 0.0};
  }
  void gains(double stiffness_N_m, double damping_N_s_m) {
    DesiredLeg& leg = command_.legs[0];
    leg.stiffness_N_m = {stiffness_N_m, 0.0, 0.7 * stiffness_N_m};
    leg.damping_N_s_m = {damping_N_s_m, 0.0, damping_N_s_m};
  }
  void enable(bool on) {
    for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = on;
    for (double& torque_Nm : torque_Nm_) torque_Nm *= on ? 1.0 : 0.0;
  }

  /// One cycle; the estimator shows what the drives give. @return the largest step, as a share of the limit.
  double step() {
    for (std::size_t j = 0; j < 2; ++j) {
      state_.joints[j].measured_motor_torque_Nm = torque_Nm_[j];
    }
    command_.stamp = state_.stamp;
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    controller_->step(state_, &command_, out_);
    EXPECT_EQ(controller_->basis(), CommandBasis::kCommanded);
    double largest = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double now_Nm = drive_torque_Nm(robot_.actuators[i], out_.actuators[i], state_.joints[i]);
      largest = std::max(largest, std::abs(now_Nm - torque_Nm_[i]) / robot_.actuators[i].torque_limit_Nm);
      torque_Nm_[i] = now_Nm;
    }
    return largest;
  }
  double steps(int cycles) {
    double largest = 0.0;
    for (int k = 0; k < cycles; ++k) largest = std::max(largest, step());
    return largest;
  }
  void switch_at_random() {
    const ControlMode modes[] = {ControlMode::kPosition, ControlMode::kJoint, ControlMode::kCompliance,
                                 ControlMode::kCompliance};
    DesiredLeg& leg = command_.legs[0];
    leg.control_mode = modes[static_cast<int>(draw(0.0, 3.999))];
    gains(draw(0.0, 3000.0), draw(0.0, 60.0));
    leg.friction_compensation = draw(0.0, 1.0);
    leg.inertia_compensation = draw(0.0, 1.0);
    leg.velocity_feedforward = draw(0.0, 1.0);
  }

  std::mt19937 random_;
  std::unique_ptr<ControllerCore> controller_;
  std::array<double, 2> torque_Nm_{};
};

TEST_P(BumplessSwitchTest, RandomSwitchesOfModeGainsAndCompensation) {
  for (int run = 0; run < 8; ++run) {
    pose(pair(draw(0.3, 3.0), draw(0.5, 2.1)), 1.5);
    enable(false);
    step();
    enable(true);
    for (int n = 0; n < 12; ++n) {
      switch_at_random();
      ASSERT_LT(steps(1 + static_cast<int>(draw(0.0, 60.0))), kLargestStep)
          << "run " << run << " switch " << n;
    }
  }
}

TEST_P(BumplessSwitchTest, EnablingInAnyModeWithAMovingLeg) {
  for (int run = 0; run < 20; ++run) {
    pose(pair(draw(0.3, 3.0), draw(0.5, 2.1)), 5.0);
    enable(false);
    switch_at_random();
    steps(5);
    enable(true);
    ASSERT_LT(steps(80), kLargestStep) << "run " << run;
  }
}

TEST_P(BumplessSwitchTest, OutOfDampingWithAMovingLeg) {
  for (int run = 0; run < 20; ++run) {
    pose(pair(draw(0.3, 3.0), draw(0.5, 2.1)), 3.0);
    enable(true);
    want(ControlMode::kPosition);
    steps(50);
    command_.legs[0].control_mode = ControlMode::kDamping;
    steps(3);  // a safety action may step; leaving it may not
    switch_at_random();
    ASSERT_LT(steps(80), kLargestStep) << "run " << run;
  }
}

TEST_P(BumplessSwitchTest, LegThatRestsInsideASoftStop) {
  const double knee_rad = robot_.joints[1].position_max_rad - 0.03;
  for (int run = 0; run < 8; ++run) {
    pose(pair(draw(1.0, 3.0), knee_rad), 0.0);
    // Held where it is: a set-point that runs into its limit is stopped there, and that is no switch.
    DesiredLeg& leg = command_.legs[0];
    leg.desired_foot_in_hip_m = to_vec3(leg_->foot_in_hip_m(measured()));
    leg.desired_foot_velocity_m_s = {0.0, 0.0, 0.0};
    leg.desired_joint_position_rad = {measured()[0], measured()[1], 0.0};
    enable(true);
    want(ControlMode::kPosition);
    steps(60);
    for (int n = 0; n < 6; ++n) {
      switch_at_random();
      ASSERT_LT(steps(1 + static_cast<int>(draw(0.0, 60.0))), kLargestStep)
          << "run " << run << " switch " << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BumplessSwitchTest, testing::Range(1, 13));

/// The test can fail: without a ramp, a change of stiffness is a step.
class BumpyPresetTest : public ControllerFixture {};

TEST_F(BumpyPresetTest, WithoutARampAChangeOfStiffnessIsAStep) {
  want(ControlMode::kCompliance);
  command_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.47};
  command_.legs[0].stiffness_N_m = {500.0, 0.0, 500.0};
  cycles(60);
  const double before_Nm = commanded_torque()[1];
  command_.legs[0].stiffness_N_m = {6000.0, 0.0, 6000.0};
  cycle();
  EXPECT_GT(std::abs(commanded_torque()[1] - before_Nm), kLargestStep * robot_.actuators[1].torque_limit_Nm);
}

}  // namespace
}  // namespace sprung
