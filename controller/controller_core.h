#pragma once
/// Leg controller: desired foot motion to drive set-points. Pure: no I/O, clock, log or heap in step.
#include <memory>

#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

class ControllerCore {
 public:
  ControllerCore(const RobotConfig& robot, const PresetConfig& preset, const WatchdogConfig& watchdogs);
  ~ControllerCore();
  ControllerCore(const ControllerCore&) = delete;
  ControllerCore& operator=(const ControllerCore&) = delete;

  /// DRIVE_COMMAND(k) from JOINT_STATE(k) and the newest LEG_COMMAND of seq <= k-1 (nullptr: none yet), extrapolated by its
  /// derivatives to now. Stale, non-finite or unsafe input gives a damping command.
  void step(const JointState& state, const LegCommand* command, DriveCommand& out) noexcept;

  /// What to send when JOINT_STATE itself has stopped: damping at the last cycle's stamp.
  void inputs_stopped(DriveCommand& out) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
