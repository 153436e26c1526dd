#pragma once
/// How near the motors come to what voltage allows: with the plant's true windings, so for experiments alone.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"

namespace sprung {

struct VoltageReserve {
  /// Least over joints and cycles of 1 - |R i + Ke w| / (0.9 U); negative: more than there is. NaN where no
  /// drive of sim.yaml has a winding.
  double least = kNaN;
  std::string actuator;  ///< whose that was
};

class VoltageReserveWatch {
 public:
  /// Of the supply: what a drive's power stage lets through (facts D10).
  static constexpr double kUsable = 0.9;

  /// @throws ConfigError as SimCore.
  VoltageReserveWatch(const RobotConfig& robot, const SimOptions& sim);
  /// Once a cycle.
  void add(SimCore& sim);
  /// One actuator in one cycle. Pure.
  void add(std::size_t actuator, double winding_V, double supply_V);
  const VoltageReserve& result() const noexcept { return result_; }

 private:
  struct Watched {
    int actuator = 0;
    double supply_V = 0.0;  ///< where the plant has no supply of its own
  };
  std::vector<std::string> names_;
  std::vector<Watched> watched_;  ///< those with a winding
  VoltageReserve result_;
};

}  // namespace sprung
