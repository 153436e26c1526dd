/// Any DRIVE_STATE and IMU to the estimator: what it calls good is finite.
#include <cmath>

#include "estimator/estimator_core.h"
#include "robots/robot_loader.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/sensors.h"
#include "tests/fuzz/any_signal.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::estimator_states {
namespace {

const std::vector<RobotConfig>& robots() {
  static const std::vector<RobotConfig> all{load_robot(test::source_dir() + "/robots/single_leg"),
                                            load_robot(test::source_dir() + "/robots/pegasus")};
  return all;
}

DriveState measured(const RobotConfig& robot) {
  DriveState state(robot.actuators.size());
  state.safety = SafetyLevel::kOperational;
  for (ActuatorState& actuator : state.actuators) {
    actuator.measured_position_rad = 0.3;
    actuator.measured_link_position_rad = 0.3;
    actuator.measured_current_A = 1.0;
    actuator.measured_supply_V = 48.0;
    actuator.power_state = PowerState::kOperationEnabled;
    actuator.shown_mode = DriveMode::kTorque;
    actuator.referenced = true;
  }
  return state;
}

Imu level() {
  Imu imu;
  imu.measured_angular_velocity_rad_s = {0, 0, 0};
  imu.measured_specific_force_m_s2 = {0, 0, 9.81};
  imu.measured_quaternion_wxyz = {1, 0, 0, 0};
  imu.status = ImuStatus::kGood;
  return imu;
}

void require_sane(const JointState& state) {
  for (const EstimatedJoint& joint : state.joints) {
    if (joint.status != JointStatus::kOk) continue;
    require(std::isfinite(joint.estimated_position_rad), "a good joint has a position");
    require(std::isfinite(joint.estimated_velocity_rad_s), "and a velocity");
    require(std::isfinite(joint.gear_output_torque_Nm), "and a torque");
  }
}

std::vector<std::string> state_seeds() {
  std::vector<std::string> seeds;
  for (const int robot : {0, 1}) {
    Output calm, changed;
    calm.byte(robot);
    changed.byte(robot);
    for (int i = 0; i < 30; ++i) calm.byte(1).byte(0).byte(0);
    for (int i = 0; i < 30; ++i) {
      changed.byte(i % 4).byte(i % 2).text(
          i % 2 != 0 ? std::string{0, static_cast<char>(i), 0, static_cast<char>(i % 16)} : "");
      changed.byte(i % 3 == 0 ? 1 : 0)
          .text(i % 3 == 0 ? std::string{0, static_cast<char>(7 * i), 0, static_cast<char>(i % 16)} : "");
    }
    seeds.push_back(calm.bytes());
    seeds.push_back(changed.bytes());
  }
  return seeds;
}

}  // namespace

/// Robot; then for each cycle how many cycles after the one before it comes, and what is changed in it.
SPRUNG_FUZZ(estimator_states, state_seeds) {
  const RobotConfig& robot = robots()[input.byte() % robots().size()];
  EstimatorCore core(robot);
  JointState out(robot.joints.size(), robot.legs.size());
  Stamp stamp{0, 0};
  for (int cycle = 0; cycle < 100 && !input.done(); ++cycle) {
    const int later = input.byte() % 8;
    stamp = {stamp.utime_us + later * 1000, stamp.seq + later};
    DriveState state = measured(robot);
    Imu imu = level();
    state.stamp = imu.stamp = stamp;
    if (!change(input, state) || !change(input, imu)) continue;
    core.step(state, out, &imu);
    require_sane(out);
  }
}

}  // namespace sprung::fuzz::estimator_states
