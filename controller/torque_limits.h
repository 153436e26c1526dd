#pragma once
/// What comes last before a torque leaves, and who acted. Pure.
#include <cstdint>

#include "robots/robot_config.h"

namespace sprung {

/// How often each limit changed a set-point, since construction. Counted for each joint (soft stop, position,
/// velocity) or actuator (torque, rate) and cycle.
struct LimitCounts {
  std::int64_t soft_stop = 0;  ///< torque mode: pushed back from a joint limit
  std::int64_t torque = 0;     ///< actuator's torque limit
  std::int64_t rate = 0;       ///< torque may not change faster
  std::int64_t position = 0;   ///< position mode: set-point held inside the joint limits
  std::int64_t velocity = 0;  ///< position mode: velocity feed-forward held inside the actuator's speed limit
};

/// Joint limits keep this distance: encoder offset and linkage play.
inline constexpr double kPositionMargin_rad = 0.02;
/// Torque mode: from this distance on a joint limit pushes back.
inline constexpr double kSoftStopZone_rad = 0.06;

/// Spring and damper at a joint's limits, added to `torque_Nm`; acts inside the zone, damps only motion into
/// the stop.
/// @param stiffness_Nm_rad, damping_Nm_s_rad those of the drive's position loop, which the joint is known to
/// bear.
double with_soft_stop(double torque_Nm, const JointConfig& joint, double position_rad, double velocity_rad_s,
                      double stiffness_Nm_rad, double damping_Nm_s_rad, LimitCounts& counts) noexcept;

/// Torque and rate limit of one actuator.
class TorqueLimiter {
 public:
  explicit TorqueLimiter(const ActuatorConfig& actuator) noexcept;
  /// Continue from here: what the drive gives now.
  void start_from(double torque_Nm) noexcept;
  double limit(double torque_Nm, double cycle_s, LimitCounts& counts) noexcept;

 private:
  double limit_Nm_;
  double last_Nm_ = 0.0;
};

}  // namespace sprung
