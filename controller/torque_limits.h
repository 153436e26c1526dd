#pragma once
/// What comes last before a torque leaves, and who acted. Pure.
#include <cstdint>

#include "robots/robot_config.h"

namespace sprung {

/// How often each limit changed a set-point, since construction. Counted for each joint (soft stop, position)
/// or actuator (all others) and cycle.
struct LimitCounts {
  std::int64_t soft_stop = 0;  ///< torque mode: pushed back from a joint limit
  std::int64_t torque = 0;     ///< actuator's torque limit
  std::int64_t speed = 0;      ///< torque mode: near the actuator's speed limit none that makes it faster
  std::int64_t power = 0;      ///< torque mode: mechanical power that the actuator may give
  std::int64_t rate = 0;       ///< torque may not change faster
  std::int64_t position = 0;   ///< position mode: set-point held inside the joint limits
  std::int64_t velocity = 0;  ///< position mode: velocity feed-forward held inside the actuator's speed limit
  std::int64_t window = 0;    ///< position mode: set-point held near the actuator (position_window.h)

  LimitCounts& operator+=(const LimitCounts& other) noexcept;
  std::int64_t total() const noexcept {
    return soft_stop + torque + speed + power + rate + position + velocity + window;
  }
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

/// From this share of the speed limit on, torque toward more speed falls in a straight line to none at the
/// limit, and beyond it brakes. The same as simulated drives do by 0x6080 [design choice].
inline constexpr double kSpeedBand = 0.1;

/// Torque, speed, power and rate limit of one actuator, in this order.
class TorqueLimiter {
 public:
  explicit TorqueLimiter(const ActuatorConfig& actuator) noexcept;
  /// Continue from here: what the drive gives now.
  void start_from(double torque_Nm) noexcept;
  /// @param velocity_rad_s of the actuator, measured.
  double limit(double torque_Nm, double velocity_rad_s, double cycle_s, LimitCounts& counts) noexcept;

 private:
  double within_speed(double torque_Nm, double velocity_rad_s) const noexcept;
  double within_power(double torque_Nm, double velocity_rad_s) const noexcept;

  double limit_Nm_;
  double fastest_rad_s_;
  double power_W_;  ///< 0: not limited
  double last_Nm_ = 0.0;
};

}  // namespace sprung
