#include "controller/torque_limits.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Zero to full torque in this time. The drive's current loop (94 Hz, facts C2) needs 4 ms for it, so that in
/// a healthy jump this limit only trims what the drive could not have followed.
constexpr double kFullTorque_s = 0.002;

}  // namespace

double with_soft_stop(double torque_Nm, const JointConfig& joint, double position_rad, double velocity_rad_s,
                      double stiffness_Nm_rad, double damping_Nm_s_rad, LimitCounts& counts) noexcept {
  const double below = joint.position_min_rad + kSoftStopZone_rad - position_rad;
  const double above = position_rad - (joint.position_max_rad - kSoftStopZone_rad);
  if (below <= 0.0 && above <= 0.0) return torque_Nm;
  ++counts.soft_stop;
  if (below > 0.0) {
    return torque_Nm + stiffness_Nm_rad * below + damping_Nm_s_rad * std::max(0.0, -velocity_rad_s);
  }
  return torque_Nm - stiffness_Nm_rad * above - damping_Nm_s_rad * std::max(0.0, velocity_rad_s);
}

TorqueLimiter::TorqueLimiter(const ActuatorConfig& actuator) noexcept : limit_Nm_(actuator.torque_limit_Nm) {}

void TorqueLimiter::start_from(double torque_Nm) noexcept {
  last_Nm_ = std::isfinite(torque_Nm) ? std::clamp(torque_Nm, -limit_Nm_, limit_Nm_) : 0.0;
}

double TorqueLimiter::limit(double torque_Nm, double cycle_s, LimitCounts& counts) noexcept {
  const double step = limit_Nm_ * cycle_s / kFullTorque_s;
  const double allowed = std::clamp(torque_Nm, -limit_Nm_, limit_Nm_);
  if (allowed != torque_Nm) ++counts.torque;
  const double slewed = std::clamp(allowed, last_Nm_ - step, last_Nm_ + step);
  if (slewed != allowed) ++counts.rate;
  last_Nm_ = slewed;
  return slewed;
}

}  // namespace sprung
