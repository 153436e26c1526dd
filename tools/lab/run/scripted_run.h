#pragma once
/// A run that anyone can repeat: commands at fixed cycles, a seed, a number of cycles. The in-process and the
/// separate-process runner give the observer the same values, bit for bit.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "signals/simulation.h"
#include "simulation/in_process/inprocess_robot.h"
#include "simulation/sim_core.h"
#include "tools/operate/client/cycle_record.h"

namespace sprung {

struct RunScript {
  RobotConfig robot;
  std::string preset;
  SimOptions sim;
  std::vector<OperatorCommand> commands;  ///< request_id and apply_at_seq set
  std::int64_t cycles = 0;                ///< cycles 0 .. cycles-1 are run
  std::vector<SimControl> controls{};     ///< of the simulated robot, apply_at_seq set; at most 64
  /// Instead of the planner: for motions that no planner makes. In one process only.
  LegCommandSource command_legs_by{};
};

/// @throws std::runtime_error when the drives do not boot or the plant fails.
void run_in_process(const RunScript& script, const CycleObserver& on_cycle, const ReplyObserver& on_reply);

/// run_in_process, or run_separate with its options.
using ScriptRunner = std::function<void(const RunScript&, const CycleObserver&, const ReplyObserver&)>;

/// For scripts of which every command must be obeyed. @throws std::runtime_error with the reason where one
/// was refused or failed.
void throw_unless_obeyed(const OperatorReply& reply);

/// A command of this kind for cycle `at_seq`; the id is the cycle's number plus one.
OperatorCommand scripted(OperatorKind kind, std::int64_t at_seq);

}  // namespace sprung
