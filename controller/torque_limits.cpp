#include "controller/torque_limits.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Zero to full torque in this time, which the drive's current loop (94 Hz, facts C2) needs too, so that in a
/// healthy jump this limit only trims what the drive could not have followed.
constexpr double kFullTorque_s = 0.004;

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

LimitCounts& LimitCounts::operator+=(const LimitCounts& other) noexcept {
  soft_stop += other.soft_stop;
  torque += other.torque;
  speed += other.speed;
  power += other.power;
  rate += other.rate;
  position += other.position;
  velocity += other.velocity;
  window += other.window;
  return *this;
}

TorqueLimiter::TorqueLimiter(const ActuatorConfig& actuator) noexcept
    : limit_Nm_(actuator.torque_limit_Nm),
      fastest_rad_s_(actuator.speed_limit_rad_s),
      power_W_(actuator.power_limit_W) {}

void TorqueLimiter::start_from(double torque_Nm) noexcept {
  last_Nm_ = std::isfinite(torque_Nm) ? std::clamp(torque_Nm, -limit_Nm_, limit_Nm_) : 0.0;
}

double TorqueLimiter::within_speed(double torque_Nm, double velocity_rad_s) const noexcept {
  if (fastest_rad_s_ <= 0.0) return torque_Nm;
  const auto bound_Nm = [&](double toward_rad_s) {
    const double room = (fastest_rad_s_ - toward_rad_s) / (kSpeedBand * fastest_rad_s_);
    return limit_Nm_ * std::clamp(room, -1.0, 1.0);
  };
  return std::clamp(torque_Nm, -bound_Nm(-velocity_rad_s), bound_Nm(velocity_rad_s));
}

/// Braking is not limited: it must always be possible.
double TorqueLimiter::within_power(double torque_Nm, double velocity_rad_s) const noexcept {
  if (power_W_ <= 0.0 || torque_Nm * velocity_rad_s <= power_W_) return torque_Nm;
  return power_W_ / velocity_rad_s;
}

double TorqueLimiter::limit(double torque_Nm, double velocity_rad_s, double cycle_s,
                            LimitCounts& counts) noexcept {
  const double step = limit_Nm_ * cycle_s / kFullTorque_s;
  const double allowed = std::clamp(torque_Nm, -limit_Nm_, limit_Nm_);
  if (allowed != torque_Nm) ++counts.torque;
  const double slow = within_speed(allowed, velocity_rad_s);
  if (slow != allowed) ++counts.speed;
  const double weak = within_power(slow, velocity_rad_s);
  if (weak != slow) ++counts.power;
  const double slewed = std::clamp(weak, last_Nm_ - step, last_Nm_ + step);
  if (slewed != weak) ++counts.rate;
  last_Nm_ = slewed;
  return slewed;
}

}  // namespace sprung
