#pragma once
/// AUXILIARY_STATE: temperatures of the drives, and the battery. Units: lcmtypes/auxiliary_state.lcm.
#include <cstddef>
#include <vector>

#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct AuxiliaryState {
  Stamp stamp;
  std::vector<double> measured_temperature_degC;  ///< an actuator each
  double battery_voltage_V = kNaN;
  double battery_charge_share = kNaN;
  double battery_temperature_degC = kNaN;
  AuxiliaryState() = default;
  explicit AuxiliaryState(std::size_t actuators) : measured_temperature_degC(actuators, kNaN) {}
};

}  // namespace sprung
