#include "tools/lab/jump/jump_trace.h"

#include <cmath>
#include <stdexcept>

namespace sprung {

namespace {

JumpSample sample_of(const CycleRecord& cycle) {
  const SimTruth& truth = cycle.truth;
  JumpSample out{};
  out.time_s = 1e-6 * static_cast<double>(truth.stamp.utime_us);
  out.desired_y_m = cycle.leg_command.legs.front().desired_foot_in_hip_m[2];
  out.hip_m = truth.base_in_world_m[2];
  out.y_m = truth.legs.front().true_foot_in_world_m[2] - out.hip_m;
  out.ground_N = truth.legs.front().true_contact_force_N[2];
  out.hip_motor_side_Nm = cycle.joint_state.joints[0].motor_side_torque_Nm;
  out.hip_output_Nm = truth.joints[0].true_gear_output_torque_Nm;
  out.knee_motor_side_Nm = cycle.joint_state.joints[1].motor_side_torque_Nm;
  out.knee_output_Nm = truth.joints[1].true_gear_output_torque_Nm;
  out.phase = cycle.motion_state.state;
  return out;
}

}  // namespace

JumpTrace::JumpTrace(const RobotConfig& robot) {
  if (robot.joints.size() < 2) throw std::invalid_argument("robot " + robot.name + " has no hip and knee");
}

void JumpTrace::add(const CycleRecord& cycle) {
  const bool begun = std::isfinite(thrust_s_);
  if (!begun && cycle.motion_state.state != MotionPhase::kCrouch &&
      cycle.motion_state.state != MotionPhase::kThrust) {
    return;
  }
  JumpSample sample = sample_of(cycle);
  if (begun) sample.time_s -= thrust_s_;
  if (begun && sample.time_s > kAfter_s) return;
  samples_.push_back(sample);
  if (!begun && sample.phase == MotionPhase::kThrust) {
    thrust_s_ = sample.time_s;
    drop_early();
  }
}

void JumpTrace::drop_early() {
  std::vector<JumpSample> kept;
  for (JumpSample sample : samples_) {
    sample.time_s -= thrust_s_;
    if (sample.time_s >= -kBefore_s) kept.push_back(sample);
  }
  samples_ = std::move(kept);
}

}  // namespace sprung
