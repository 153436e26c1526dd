#pragma once
/// The voltage that all drives of a robot share: a source behind a resistance sags under load, what brakes
/// charges the capacitor at the drives, a chopper burns what is too much. Pure; once a step.
#include "simulation/plant/drive_truth.h"

namespace sprung::sim {

class PowerSupply {
 public:
  explicit PowerSupply(const SupplyConfig& config) noexcept : config_(config), voltage_V_(config.voltage_V) {}

  /// @param drawn_W by all drives together; negative: they brake. More than voltage^2 / (4 resistance) no
  /// source can give: the voltage breaks down, to kLeast_V.
  void step(double drawn_W, double dt_s) noexcept;
  /// Charged again, without load.
  void reset() noexcept { voltage_V_ = config_.voltage_V; }
  double voltage_V() const noexcept { return voltage_V_; }

  static constexpr double kLeast_V = 1.0;  ///< so that power over voltage stays a current [design choice]

 private:
  SupplyConfig config_;
  double voltage_V_;
};

}  // namespace sprung::sim
