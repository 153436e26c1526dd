#pragma once
/// JOINT_STATE of a robot that stands square on level ground, at rest, each foot under its hip.
#include "model/leg_kinematics.h"
#include "planner/gait/body_view.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"

namespace sprung::test {

inline JointState standing(const RobotConfig& robot, double height_m = 0.5) {
  const BodyShape shape(robot);
  JointState out(robot.joints.size(), robot.legs.size());
  out.body.estimated_quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
  out.body.estimated_angular_velocity_rad_s = {0.0, 0.0, 0.0};
  out.body.estimated_velocity_m_s = {0.0, 0.0, 0.0};
  out.body.estimated_height_m = height_m;
  out.body.uses_imu = true;
  for (std::size_t i = 0; i < out.legs.size(); ++i) {
    Eigen::Vector3d foot_m = shape.foot_beside_hip_m[i];
    foot_m.z() = -height_m;
    out.legs[i].estimated_foot_in_hip_m = to_vec3(foot_m);
    out.legs[i].contact = true;
  }
  return out;
}

}  // namespace sprung::test
