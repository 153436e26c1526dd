/// The torque of a joint from its motor's current and encoder: sprung's estimator in a program of your own.
/// Reads lines "time in us, position in rad, current in A"; prints the time and two torques in Nm, the
/// motor's and the gear's output.
#include <sprung/estimator/estimator_core.h>
#include <sprung/robots/robot_loader.h>

#include <cstdio>

int main(int argc, char** argv) {
  const sprung::RobotConfig robot = sprung::load_robot(argc > 1 ? argv[1] : "test_axis");
  sprung::EstimatorCore estimator(robot);
  sprung::DriveState drives(robot.actuators.size());
  sprung::JointState joints(robot.joints.size(), robot.legs.size());
  sprung::ActuatorState& motor = drives.actuators.front();
  motor.referenced = true;
  // As a drive that has power: while it moves, the estimator follows the friction's temperature.
  motor.power_state = sprung::PowerState::kOperationEnabled;
  motor.shown_mode = sprung::DriveMode::kTorque;
  long time_us = 0;
  while (std::scanf("%ld,%lf,%lf", &time_us, &motor.measured_position_rad, &motor.measured_current_A) == 3) {
    drives.stamp = {time_us, drives.stamp.seq + 1};
    estimator.step(drives, joints);
    const sprung::EstimatedJoint& joint = joints.joints.front();
    std::printf("%ld,%.17g,%.17g\n", time_us, joint.motor_side_torque_Nm, joint.gear_output_torque_Nm);
  }
}
