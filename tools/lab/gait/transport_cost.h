#pragma once
/// What walking costs: all that the robot takes from its supply, over its weight (robot.yaml's) times its
/// way.
#include <vector>

#include "signals/simulation.h"
#include "tools/lab/gait/motor_windings.h"

namespace sprung {

class TransportCost {
 public:
  /// [design choice] Computer and encoders, and what each drive takes by itself [U].
  static constexpr double kComputer_W = 15.0, kDrive_W = 3.0;

  /// @throws ConfigError as SimCore.
  TransportCost(const RobotConfig& robot, const SimOptions& sim);
  /// Once a cycle. What motors that brake give back others may use; more than these is burnt.
  void add(const SimTruth& truth);

  /// Base load included. NaN where a motor has no winding in sim.yaml, turns more than a joint, or nothing
  /// was added.
  double mean_W() const noexcept;
  double base_W() const noexcept { return base_W_; }
  /// Without unit. @param speed_m_s mean, over the ground.
  double at(double speed_m_s) const noexcept;

 private:
  std::vector<MotorWinding> windings_;
  bool known_ = false;
  double base_W_ = 0.0, weight_N_ = 0.0, sum_W_ = 0.0;
  int cycles_ = 0;
};

}  // namespace sprung
