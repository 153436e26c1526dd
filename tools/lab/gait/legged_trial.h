#pragma once
/// A walking robot in this process, for experiments that look and push in every cycle: brought to its feet
/// (or to hang with its legs under it) by the operator's commands alone, as on the bench.
#include <functional>
#include <string>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {

class LeggedTrial {
 public:
  /// After every cycle. May push by robot.sim().control().
  using OnCycle = std::function<void(InProcessRobot& robot)>;

  /// Boots the drives. @throws std::invalid_argument for a robot that does not walk, else as InProcessRobot.
  LeggedTrial(const RobotConfig& robot, const std::string& preset, const SimOptions& sim);

  /// `home --from link` once all joints rest, then `stand`, until it stands. @throws std::runtime_error with
  /// the reason where it does not.
  void stand_up();
  /// Executed in the next cycle; @throws std::runtime_error from run() where it is refused.
  void say(OperatorCommand command);
  /// @throws std::runtime_error when the plant fails, a command is refused, or the robot has left its feet
  /// (state idle or fallen).
  void run(double duration_s, const OnCycle& on_cycle = {});

  InProcessRobot& robot() noexcept { return robot_; }
  double simulated_s() const noexcept { return static_cast<double>(robot_.cycle()) * cycle_s_; }

 private:
  void wait_for_rest();
  void check() const;

  const RobotConfig& config_;
  double cycle_s_;
  double rise_s_;
  bool up_ = false;
  std::int64_t said_ = 0;
  InProcessRobot robot_;
};

/// A plant whose trunk lies on the floor, free: where a walking robot begins.
SimOptions lying(SimOptions sim);

/// Index of the gait of this name. @throws std::invalid_argument where the robot has none.
int gait_index(const RobotConfig& robot, const std::string& name);

}  // namespace sprung
