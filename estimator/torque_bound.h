#pragma once
/// How wrong an estimated torque may be, at 95 %. What is not known has independent causes, so that variances
/// add up: friction, torque constant and armature of this joint by robot.yaml's `uncertainty`, the filter's
/// own covariance, what the filter did not expect, the current's resolution. At rest friction may be anything
/// that the gear can hold. Pure.
#include "robots/robot_config.h"

namespace sprung {

inline constexpr double kBoundProbability = 0.95;
/// Standard deviations to either side that hold 95 % of a normal distribution.
inline constexpr double kBoundStds = 1.96;
/// Instead of 1.96, found on the tuning half of the ensemble (docs/estimation.md): a plant whose friction or
/// torque constant is off is off for the whole run, and plants at the edge must keep 85 % too; the filter's
/// covariance allows for an impact in every cycle, and its errors are half of it.
inline constexpr double kModelStds = 2.25;
inline constexpr double kFilterStds = 0.93;

struct TorqueBoundInput {
  double motor_torque_Nm = 0.0;  ///< joint side, R Kt i
  double friction_std_Nm = 0.0;  ///< of the law's friction, at rest of the largest that it allows
  double by_friction = 1.0;      ///< derivative of the output torque by friction, less than 1 where friction
                                 ///< follows the load
  double acceleration_rad_s2 = 0.0;
  double filter_std_rad_s2 = 0.0;        ///< of the acceleration that the motor does not explain
  double filter_step_rad_s2 = 0.0;       ///< by which the last sample changed it
  double current_quantisation_Nm = 0.0;  ///< half a step of the drive's current, joint side
  double rest_distance_Nm = 0.0;         ///< at rest: to the far end of what is possible
};

struct [[nodiscard]] TorqueBounds {
  double gear_output_Nm = 0.0;
  double friction_Nm = 0.0;
};

TorqueBounds torque_bounds(const JointConfig& joint, const TorqueBoundInput& in) noexcept;

}  // namespace sprung
