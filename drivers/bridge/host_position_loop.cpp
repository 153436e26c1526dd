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
  const double error_rad = commanded_position_rad - 0.5 * step_rad - measured_position_rad;
  const double torque_Nm = stiffness_Nm_rad_ * error_rad +
                           damping_Nm_s_rad_ * (step_rad / cycle_s_ - measured_velocity_rad_s);
  if (!std::isfinite(torque_Nm)) return 0.0;
  const bool too_fast = std::abs(measured_velocity_rad_s) > speed_limit_rad_s_;
  if (too_fast && torque_Nm * measured_velocity_rad_s > 0.0) return 0.0;
  return std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
}

void HostPositionLoop::forget() noexcept { set_position_rad_ = kNaN; }

bool HostPositionLoop::closed() const noexcept { return std::isfinite(set_position_rad_); }

}  // namespace sprung
