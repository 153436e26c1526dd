#pragma once
/// What JOINT_STATE says about the body and its feet, in level axes (body_frame.h). Pure.
#include <array>
#include <vector>

#include "planner/gait/body_frame.h"
#include "planner/gait/gait_clock.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"

namespace sprung {

/// What its trunk carries beyond robot.yaml's masses, as far as laws use it.
struct LoadOnTrunk {
  double mass_kg = 0.0;
  Eigen::Vector2d com_shift_m = Eigen::Vector2d::Zero();  ///< of all; trunk axes, forward and left
};

/// The robot as a body on legs: what does not change but by what it carries.
struct BodyShape {
  explicit BodyShape(const RobotConfig& robot);

  std::size_t legs = 0;
  double mass_kg = 0.0;  ///< of all, load included
  std::array<Eigen::Vector3d, kMostLegs> hip_in_trunk_m{};
  /// Foot of a leg that stands straight under its hip, from the hip: sideways by the leg's own offset.
  std::array<Eigen::Vector3d, kMostLegs> foot_beside_hip_m{};
  std::array<double, kMostLegs> foot_radius_m{};
  std::array<double, kMostLegs> side{};              ///< +1 left, -1 right
  std::array<std::vector<int>, kMostLegs> joints{};  ///< indices into JOINT_STATE's

  Eigen::Vector3d com_in_trunk_m(const JointState& in) const noexcept;
  void carry(const LoadOnTrunk& load) noexcept;

 private:
  LoadOnTrunk load_;
  BodyConfig body_;
  std::array<double, kMostLegs> hip_mass_kg_{};
  std::array<double, kMostLegs> leg_mass_kg_{};
};

struct BodyView {
  Attitude attitude;
  Eigen::Matrix3d level_from_trunk = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  ///< level axes; zero where it is not known
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();  ///< from the middle of the hips, level axes
  std::array<Eigen::Vector3d, kMostLegs> foot_m{};  ///< the same
  std::array<bool, kMostLegs> carries{};            ///< something, or nobody knows
  bool uses_imu = false;
  bool velocity_known = false;

  /// Unknown attitude counts as level.
  static BodyView of(const JointState& in, const BodyShape& shape) noexcept;
};

}  // namespace sprung
