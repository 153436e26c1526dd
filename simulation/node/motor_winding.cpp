#include "simulation/node/motor_winding.h"

#include <algorithm>

namespace sprung::sim {

MotorWinding::MotorWinding(const SimDriveConfig& truth, double gear_ratio, bool limits) noexcept
    : gear_ratio_(gear_ratio), limits_(limits && truth.winding.has_value()) {
  if (!truth.winding) return;
  resistance_ohm_ = truth.winding->resistance_ohm;
  back_emf_V_s_rad_ = truth.winding->back_emf_V_s_rad.value_or(truth.torque_constant_Nm_A);
  voltage_share_ = truth.winding->voltage_share;
}

void MotorWinding::turn(double shaft_rad_s, double share) noexcept {
  emf_V_ = back_emf_V_s_rad_ * share * gear_ratio_ * shaft_rad_s;
}

double MotorWinding::reachable_A(double target_A, double supply_V) const noexcept {
  if (!limits_) return target_A;
  const double most_V = voltage_share_ * supply_V;
  return std::clamp(target_A, (-most_V - emf_V_) / resistance_ohm_, (most_V - emf_V_) / resistance_ohm_);
}

WindingState MotorWinding::state(double current_A) const noexcept {
  const double voltage_V = resistance_ohm_ * current_A + emf_V_;
  return {voltage_V, voltage_V * current_A};
}

}  // namespace sprung::sim
