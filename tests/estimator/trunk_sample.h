#pragma once
/// A trunk on four feet that moves as told, and what its legs and an IMU say about it: synthetic, exact
/// unless asked.
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/sensors.h"

namespace sprung::test {

struct TrunkPose {
  Eigen::Vector3d in_world_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond to_world = Eigen::Quaterniond::Identity();
};

/// Roll, pitch, yaw in the usual order (yaw last).
inline Eigen::Quaterniond rpy(double roll, double pitch, double yaw) {
  return turned_by({0, 0, yaw}) * turned_by({0, pitch, 0}) * turned_by({roll, 0, 0});
}

/// Hips as pegasus, legs as three_joint.
inline RobotConfig four_legs() {
  RobotConfig robot;
  robot.cycle_s = 0.002;
  robot.body.mass_kg = 12.0;
  robot.body.imu = true;
  for (const auto& [x, y] : {std::pair{0.33, 0.12}, {0.33, -0.12}, {-0.33, 0.12}, {-0.33, -0.12}}) {
    LegConfig leg;
    leg.hip_in_trunk_m = {x, y, 0.0};
    leg.contact_on_N = 20.0;
    robot.legs.push_back(leg);
  }
  return robot;
}

class TrunkSample {
 public:
  using Motion = std::function<TrunkPose(double time_s)>;
  explicit TrunkSample(Motion motion) : motion_(std::move(motion)) {}

  RobotConfig robot = four_legs();
  std::vector<Eigen::Vector3d> feet_in_world_m{
      {0.33, 0.2, 0}, {0.33, -0.2, 0}, {-0.33, 0.2, 0}, {-0.33, -0.2, 0}};
  std::vector<bool> stands{true, true, true, true};
  double foot_noise_m_s = 0.0;
  /// Of all last links, world axes: what their feet roll with, by the radius in `robot`.
  Eigen::Vector3d link_turning_rad_s = Eigen::Vector3d::Zero();

  TrunkPose pose(double t) const { return motion_(t); }
  Eigen::Vector3d velocity_world(double t) const {
    return (pose(t + kStep_s).in_world_m - pose(t - kStep_s).in_world_m) / (2 * kStep_s);
  }
  Eigen::Vector3d velocity_m_s(double t) const { return pose(t).to_world.conjugate() * velocity_world(t); }
  Eigen::Vector3d angular_velocity_rad_s(double t) const {
    const Eigen::Quaterniond turn = pose(t - kStep_s).to_world.conjugate() * pose(t + kStep_s).to_world;
    return turn.vec() * std::copysign(1.0 / kStep_s, turn.w());
  }
  /// Mean over the cycle before t, as an IMU that integrates.
  Eigen::Vector3d specific_force_m_s2(double t) const {
    const double dt = robot.cycle_s;
    const Eigen::Vector3d a = (velocity_world(t) - velocity_world(t - dt)) / dt;
    return pose(t).to_world.conjugate() * (a + Eigen::Vector3d(0, 0, kGravity_m_s2));
  }
  double height_m(double t) const {
    double sum = 0.0;
    int n = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (stands[i]) sum += pose(t).in_world_m.z() - feet_in_world_m[i].z(), ++n;
    return sum / n;
  }

  /// Diagonal pairs in turn, each set down where its hip will be over it in the middle of its stance.
  void trot(double t) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double since = std::fmod(t + (i == 0 || i == 3 ? 0.0 : 0.25), 0.5);
      const bool lands = since < 0.26 && !stands[i];
      stands[i] = since < 0.26;
      if (!lands) continue;
      const TrunkPose then = pose(t + 0.13);
      feet_in_world_m[i] = then.in_world_m +
                           turned_about_z(yaw_rad(then.to_world)) * to_eigen(robot.legs[i].hip_in_trunk_m);
      feet_in_world_m[i].z() = 0.0;
    }
  }

  std::vector<EstimatedLeg> legs(double t) {
    std::vector<EstimatedLeg> out(4);
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d hip = to_eigen(robot.legs[i].hip_in_trunk_m);
      out[i].estimated_foot_in_hip_m = to_vec3(in_trunk(i, t) - hip);
      Eigen::Vector3d v = (in_trunk(i, t + kStep_s) - in_trunk(i, t - kStep_s)) / (2 * kStep_s);
      for (int axis = 0; axis < 3; ++axis) v[axis] += foot_noise_m_s * normal_(random_);
      out[i].estimated_foot_velocity_m_s = to_vec3(v);
      out[i].foot_force_N = {0, 0, stands[i] ? 75.0 : 0.0};
      out[i].contact = stands[i];
      out[i].contact_confidence = stands[i] ? 1.0 : 0.0;
    }
    return out;
  }
  std::vector<Eigen::Vector3d> link_rates_rad_s(double t) const {
    const Eigen::Vector3d turning_rad_s = pose(t).to_world.conjugate() * link_turning_rad_s;
    return std::vector<Eigen::Vector3d>(4, turning_rad_s - angular_velocity_rad_s(t));
  }
  /// @param yaw_rad of the IMU's own world against ours.
  Imu imu(double t, std::int64_t seq, double yaw_rad = 0.0) const {
    Imu out;
    out.stamp.seq = seq;
    out.status = ImuStatus::kGood;
    out.measured_angular_velocity_rad_s = to_vec3(angular_velocity_rad_s(t));
    out.measured_specific_force_m_s2 = to_vec3(specific_force_m_s2(t));
    const Eigen::Quaterniond q = turned_about_z(yaw_rad) * pose(t).to_world;
    out.measured_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
    return out;
  }

 private:
  static constexpr double kStep_s = 1e-5;
  Eigen::Vector3d in_trunk(std::size_t i, double t) const {
    const TrunkPose at = pose(t);
    const Eigen::Vector3d rolled_m = t * robot.legs[i].foot_radius_m *
                                     link_turning_rad_s.cross(Eigen::Vector3d::UnitZ());
    return at.to_world.conjugate() * (feet_in_world_m[i] + rolled_m - at.in_world_m);
  }
  Motion motion_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

/// Angle between two attitudes.
inline double angle_rad(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b);
}
inline Eigen::Quaterniond quaternion(const EstimatedBody& body) {
  const auto& q = body.estimated_quaternion_wxyz;
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace sprung::test
