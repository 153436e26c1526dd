#pragma once
/// Options that every process of the stack has; `sprung up` gives them all.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/command_line.h"
#include "runtime/node.h"
#include "runtime/real_time.h"
#include "signals/enumeration.h"

namespace sprung {

enum class ClockMode { kLockstep, kRealTime };
constexpr auto words_of(ClockMode) {
  using E = ClockMode;
  return words<E>({{E::kLockstep, "lockstep"}, {E::kRealTime, "realtime"}});
}

struct ProcessOptions {
  std::string robot = "single_leg";  ///< --robot: a name or a folder
  std::string preset;                ///< --preset; empty = the robot's usual one
  std::string clock = "realtime";    ///< --clock lockstep|realtime
  std::string rt_policy = "warn";    ///< --rt-policy enforce|warn|off
  int priority = 0;                  ///< --priority
  int cpu = -1;                      ///< --cpu
  bool simulation = false;   ///< --simulation: robot.yaml's simulation_watchdogs apply (real time only)
  bool maintenance = false;  ///< --maintenance: robots/maintenance.h
  int key_fd = -1;           ///< --key-fd, else $SPRUNG_KEY_FD; -1 = none
  bool no_key = false;       ///< --no-key: every message is believed (tests)
  NodeOptions node;          ///< --session, --epoch-us, --lcm-url, --inject

  ClockMode clock_mode() const noexcept;
  RealTimeRequest real_time() const noexcept;  ///< policy off in lock-step: there is no deadline to meet
};

/// Adds the options above to a command. `options` must outlive the command line.
void add_process_options(CommandLine& line, ProcessOptions& options);

/// Faults are made on simulated robots alone. @throws WrongUse on --inject in real time without --simulation.
void refuse_injection(const ProcessOptions& options);

/// The key of the run, from --key-fd, else from the descriptor that $SPRUNG_KEY_FD names; none with --no-key.
/// @throws WrongUse where there is none, and on --no-key for what may have real drives; std::runtime_error as
/// read_key_fd.
std::shared_ptr<const MessageKey> key_of(const ProcessOptions& options);

/// Which set of robot.yaml applies: simulation_watchdogs in real time with --simulation, else watchdogs.
const WatchdogConfig& watchdogs_for(const RobotConfig& robot, const ProcessOptions& options) noexcept;

/// Of the robot file and the preset in force, for PROCESS_STATUS.
std::int64_t configuration_hash(const RobotConfig& robot, const std::string& preset) noexcept;

}  // namespace sprung
