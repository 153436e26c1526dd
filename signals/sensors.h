#pragma once
/// Sensors that are no drive. Units and frames: lcmtypes/README.md.
#include <array>
#include <cstdint>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

/// An IMU on the trunk, in trunk axes (x forward, y left, z up), sampled at the SYNC of its cycle.
struct Imu {
  Stamp stamp;
  Vec3 measured_angular_velocity_rad_s{kNaN, kNaN, kNaN};
  Vec3 measured_specific_force_m_s2{kNaN, kNaN, kNaN};                     ///< at rest +9.81 up
  std::array<double, 4> measured_quaternion_wxyz{kNaN, kNaN, kNaN, kNaN};  ///< trunk axes to world axes
  ImuStatus status = ImuStatus::kStarting;
};

/// A torque sensor between a gear and its link, as measured: it may be slower than the cycle.
struct TorqueSensor {
  Stamp stamp;  ///< of the reading; seq of the cycle that it fell into
  std::int32_t joint = -1;
  double measured_torque_Nm = kNaN;  ///< of the gear on the link, sign of gear_output_torque_Nm
};

}  // namespace sprung
