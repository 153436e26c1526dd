#include "controller/position_window.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung {

PositionWindow::PositionWindow(const ActuatorConfig& actuator) noexcept
    : half_rad_(actuator.position_stiffness_Nm_rad > 0.0
                    ? kShare * actuator.torque_limit_Nm / actuator.position_stiffness_Nm_rad
                    : std::numeric_limits<double>::infinity()) {}

double PositionWindow::hold(double set_point_rad, double measured_rad, double cycle_s) noexcept {
  const bool outside = std::abs(set_point_rad - measured_rad) > half_rad_;
  held_s_ = outside ? held_s_ + cycle_s : 0.0;
  acts_ = outside && held_s_ <= kHold_limit_s;
  return acts_ ? std::clamp(set_point_rad, measured_rad - half_rad_, measured_rad + half_rad_)
               : set_point_rad;
}

}  // namespace sprung
