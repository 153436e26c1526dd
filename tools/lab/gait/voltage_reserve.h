#pragma once
/// How near the motors come to what voltage allows: with the plant's true windings, so for experiments alone.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/simulation.h"
#include "simulation/sim_core.h"
#include "tools/lab/gait/motor_windings.h"

namespace sprung {

struct VoltageReserve {
  static constexpr double kWanted = 0.10;  ///< of a robot that walks, at every moment
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
  /// The same from the truth alone, under each drive's own supply: of actuators that turn one joint and no
  /// other, since the truth is of joints.
  void add(const SimTruth& truth);
  /// One actuator in one cycle. Pure.
  void add(std::size_t actuator, double winding_V, double supply_V);
  const VoltageReserve& result() const noexcept { return result_; }

 private:
  std::vector<std::string> names_;
  std::vector<MotorWinding> windings_;
  VoltageReserve result_;
};

}  // namespace sprung
