/// Any JOINT_STATE and LEG_COMMAND to the leg controller: whatever comes, what goes to the drives is finite
/// and within their limits.
#include <cmath>

#include "controller/controller_core.h"
#include "robots/robot_loader.h"
#include "signals/drive_command.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "tests/fuzz/any_signal.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::controller_commands {
namespace {

const std::vector<RobotConfig>& robots() {
  static const std::vector<RobotConfig> all{load_robot(test::source_dir() + "/robots/single_leg"),
                                            load_robot(test::source_dir() + "/robots/pegasus")};
  return all;
}

JointState standing(const RobotConfig& robot) {
  JointState state(robot.joints.size(), robot.legs.size());
  state.stamp = {1000, 0};
  state.safety = SafetyLevel::kOperational;
  for (EstimatedJoint& joint : state.joints) {
    joint = {};
    joint.status = JointStatus::kOk;
    joint.drive_enabled = true;
    joint.estimated_position_rad = 0.3;
    joint.estimated_velocity_rad_s = 0.0;
  }
  for (EstimatedLeg& leg : state.legs) leg.estimated_foot_in_hip_m = {0.0, 0.0, -0.3};
  return state;
}

LegCommand wanted(const RobotConfig& robot, ControlMode mode) {
  LegCommand command(robot.legs.size());
  command.stamp = {0, 0};
  for (DesiredLeg& leg : command.legs) {
    leg.control_mode = mode;
    leg.desired_foot_in_hip_m = {0.0, 0.0, -0.3};
    leg.stiffness_N_m = {1000, 1000, 1000};
    leg.damping_N_s_m = {50, 50, 50};
    leg.desired_joint_position_rad = {0, 0, 0};
  }
  return command;
}

void require_sane(const RobotConfig& robot, const DriveCommand& out) {
  for (std::size_t i = 0; i < out.actuators.size(); ++i) {
    const ActuatorCommand& command = out.actuators[i];
    if (command.mode == DriveMode::kTorque)
      require(std::abs(command.commanded_torque_Nm) <= robot.actuators[i].torque_limit_Nm * 1.000001,
              "a torque within limits");
    if (command.mode == DriveMode::kPosition)
      require(std::isfinite(command.commanded_position_rad), "a place to go");
    if (command.mode == DriveMode::kDamping)
      require(command.commanded_damping_Nm_s_rad >= 0.0, "damping damps");
  }
}

std::vector<std::string> command_seeds() {
  std::vector<std::string> seeds;
  for (const int robot : {0, 1}) {
    for (int mode = 0; mode < 5; ++mode) {
      Output seed;
      seed.byte(robot).byte(0);
      for (int i = 0; i < 4; ++i) seed.byte(mode).byte(0).byte(0);
      for (int i = 0; i < 4; ++i)
        seed.byte(mode).byte(1).byte(0).number(static_cast<std::uint16_t>(200 * i)).byte(i).byte(0);
      seeds.push_back(seed.bytes());
    }
  }
  return seeds;
}

}  // namespace

/// Robot, preset; then for each cycle the mode that is wanted, and what is changed in state and command.
SPRUNG_FUZZ(controller_commands, command_seeds) {
  const RobotConfig& robot = robots()[input.byte() % robots().size()];
  ControllerCore core(robot, robot.presets[input.byte() % robot.presets.size()], robot.watchdogs);
  DriveCommand out(robot.actuators.size());
  for (int cycle = 1; cycle < 64 && !input.done(); ++cycle) {
    JointState state = standing(robot);
    LegCommand command = wanted(robot, static_cast<ControlMode>(input.byte() % 5));
    state.stamp = {1000 * cycle, cycle};
    command.stamp = {1000 * (cycle - 1), cycle - 1};
    if (!change(input, state) || !change(input, command)) continue;
    core.step(state, &command, out);
    require_sane(robot, out);
  }
}

}  // namespace sprung::fuzz::controller_commands
