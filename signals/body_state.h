#pragma once
/// BODY_STATE: the trunk's odometry. Units and frames: lcmtypes/body_state.lcm.
#include <array>
#include <cstdint>

#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

using Covariance3 = std::array<double, 9>;  ///< row by row

/// It is sent in every fifth cycle: what maps and operators follow.
inline constexpr std::int64_t kBodyState_cycles = 5;

struct BodyState {
  Stamp stamp;
  Vec3 estimated_position_in_world_m{kNaN, kNaN, kNaN};
  std::array<double, 4> estimated_quaternion_wxyz{kNaN, kNaN, kNaN, kNaN};
  Vec3 estimated_velocity_m_s{kNaN, kNaN, kNaN};  ///< trunk axes
  Vec3 estimated_rate_bias_rad_s{};               ///< of the IMU, trunk axes
  Vec3 estimated_force_bias_m_s2{};
  /// About trunk x and y, from trunk axes to the IMU's: as it is mounted askew.
  std::array<double, 2> estimated_imu_tilt_rad{};
  double estimated_sinking_m_N = 0.0;                ///< of foot and ground together
  Covariance3 position_covariance_m2{};              ///< world axes
  Covariance3 attitude_covariance_rad2{};            ///< of a small turn about world axes
  std::array<double, 4> imu_tilt_covariance_rad2{};  ///< row by row
  Covariance3 velocity_covariance_m2_s2{};           ///< world axes
  std::int32_t slips = 0;                            ///< of standing feet, since the estimator began
  bool uses_imu = false;
};

}  // namespace sprung
