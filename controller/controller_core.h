#pragma once
/// Leg controller: desired foot motion to drive set-points. Pure: no I/O, clock, log or heap in step.
#include <cstdint>
#include <memory>

#include "controller/torque_limits.h"
#include "robots/robot_config.h"
#include "signals/drive_command.h"
#include "signals/enumeration.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"

namespace sprung {

/// Why the last DRIVE_COMMAND is what it is. All but kCommanded give damping, or while a robot that stands is
/// let down (lowering.h) the drives' position loops; but no power where safety has disabled the robot, or
/// where no drive is enabled: nothing that goes wrong may switch a drive on.
enum class CommandBasis : std::int8_t {
  kCommanded = 0,      ///< as LEG_COMMAND asks, after limits
  kNoCommand = 1,      ///< none yet
  kCommandStale = 2,   ///< LEG_COMMAND older than leg_command_s, from the future, or of another robot
  kJointNotReady = 3,  ///< a joint is stale, in fault, starting or not referenced
  kNotFinite = 4,
  kUnreachable = 5,  ///< a desired foot cannot be reached
  kSafety = 6,       ///< the bridge is not operational
  kLowering = 7,     ///< no good LEG_COMMAND, so the robot is let down
};

constexpr auto words_of(CommandBasis) {
  using E = CommandBasis;
  return words<E>({{E::kCommanded, "commanded"},
                   {E::kNoCommand, "no leg command yet"},
                   {E::kCommandStale, "leg command stale"},
                   {E::kJointNotReady, "joint not ready"},
                   {E::kNotFinite, "not finite"},
                   {E::kUnreachable, "foot out of reach"},
                   {E::kSafety, "safety is not operational"},
                   {E::kLowering, "leg command stale: lowering"}});
}

class ControllerCore {
 public:
  /// @throws std::invalid_argument on kinematics, transmission or smoothing that cannot be.
  ControllerCore(const RobotConfig& robot, const PresetConfig& preset, const WatchdogConfig& watchdogs);
  ~ControllerCore();
  ControllerCore(const ControllerCore&) = delete;
  ControllerCore& operator=(const ControllerCore&) = delete;

  /// DRIVE_COMMAND(k) from JOINT_STATE(k) and the newest LEG_COMMAND of seq <= k-1 (nullptr: none yet),
  /// extrapolated by its derivatives to now. Stale, non-finite or unsafe input gives a damping command, a
  /// lowering one, or none of power: see CommandBasis.
  void step(const JointState& state, const LegCommand* command, DriveCommand& out) noexcept;

  CommandBasis basis() const noexcept;  ///< of the last command
  LimitCounts limits() const noexcept;  ///< of all legs together: which safety limits acted, and how often

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
