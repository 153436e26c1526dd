#include "simulation/plant/power_supply.h"

#include <algorithm>

namespace sprung::sim {

/// C V' = (V0 - V) / R - P / V: implicit in the source's resistance, so that no step is too long for it.
void PowerSupply::step(double drawn_W, double dt_s) noexcept {
  const bool flows = config_.takes_back || voltage_V_ < config_.voltage_V;
  const double from_source_S = flows ? 1.0 / config_.resistance_ohm : 0.0;
  const double charge_S = config_.capacity_F / dt_s;
  const double drawn_A = drawn_W / voltage_V_;
  voltage_V_ = (charge_S * voltage_V_ + from_source_S * config_.voltage_V - drawn_A) /
               (charge_S + from_source_S);
  if (config_.chopper_V > 0.0 && voltage_V_ > config_.chopper_V) {
    // It is switched so fast that it holds its voltage, as long as its resistor takes the current.
    const double most_V = voltage_V_ / config_.chopper_ohm / charge_S;
    voltage_V_ = std::max(config_.chopper_V, voltage_V_ - most_V);
  }
  voltage_V_ = std::max(voltage_V_, kLeast_V);
}

}  // namespace sprung::sim
