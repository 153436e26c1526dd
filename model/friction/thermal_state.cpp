#include "model/friction/thermal_state.h"

#include <cmath>

namespace sprung {

double ThermalState::step(double loss_W, double dt_s) noexcept {
  if (!(parameters_.time_constant_s > 0.0) || !(dt_s > 0.0)) return temperature_C_;
  const double heated_C = parameters_.ambient_C +
                          parameters_.resistance_K_W * (std::isfinite(loss_W) ? loss_W : 0.0);
  temperature_C_ = heated_C + (temperature_C_ - heated_C) * std::exp(-dt_s / parameters_.time_constant_s);
  return temperature_C_;
}

}  // namespace sprung
