#include "drivers/bridge/host_position_loop.h"

#include <algorithm>
#include <cmath>

#include "drivers/bridge/setpoint_gate.h"

namespace sprung {

HostPositionLoop::HostPositionLoop(const ActuatorConfig& actuator, double cycle_s) noexcept
    : stiffness_Nm_rad_(actuator.position_stiffness_Nm_rad),
      damping_Nm_s_rad_(actuator.position_damping_Nm_s_rad),
      torque_limit_Nm_(actuator.torque_limit_Nm),
      speed_limit_rad_s_(SetpointGate::kSpeedShare * actuator.speed_limit_rad_s),
      cycle_s_(cycle_s) {}

double HostPositionLoop::torque_Nm(double commanded_position_rad, double measured_position_rad,
                                   double measured_velocity_rad_s) noexcept {
  const double step_rad = closed() ? commanded_position_rad - set_position_rad_ : 0.0;
  set_position_rad_ = commanded_position_rad;
  const double predicted_rad = measured_position_rad + 1.5 * cycle_s_ * measured_velocity_rad_s;
  const double predicted_rad_s = predicted_velocity_rad_s(measured_velocity_rad_s);
  const double torque_Nm = stiffness_Nm_rad_ * (commanded_position_rad - 0.5 * step_rad - predicted_rad) +
                           damping_Nm_s_rad_ * (step_rad / cycle_s_ - predicted_rad_s);
  if (!std::isfinite(torque_Nm)) return 0.0;
  const bool too_fast = std::abs(measured_velocity_rad_s) > speed_limit_rad_s_;
  if (too_fast && torque_Nm * measured_velocity_rad_s > 0.0) return 0.0;
  return std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
}

double HostPositionLoop::predicted_velocity_rad_s(double measured_velocity_rad_s) noexcept {
  const double change_rad_s = measured_velocity_rad_s - last_velocity_rad_s_;
  last_velocity_rad_s_ = measured_velocity_rad_s;
  return std::isfinite(change_rad_s) ? measured_velocity_rad_s + change_rad_s : measured_velocity_rad_s;
}

void HostPositionLoop::forget() noexcept {
  set_position_rad_ = kNaN;
  last_velocity_rad_s_ = kNaN;
}

bool HostPositionLoop::closed() const noexcept { return std::isfinite(set_position_rad_); }

}  // namespace sprung
