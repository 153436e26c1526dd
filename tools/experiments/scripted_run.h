#pragma once
/// A run that anyone can repeat: commands at fixed cycles, a seed, a number of cycles. The in-process and the
/// separate-process runner give the observer the same values, bit for bit.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/sim/sim_core.h"
#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

struct RunScript {
  RobotConfig robot;
  std::string preset;
  SimOptions sim;
  std::vector<OperatorCommand> commands;  ///< request_id and apply_at_seq set
  std::int64_t cycles = 0;                ///< cycles 0 .. cycles-1 are run
};

/// What one cycle produced.
struct CycleRecord {
  const DriveState& drive_state;
  const JointState& joint_state;
  const MotionState& motion_state;
  const DriveCommand& drive_command;
  const SimTruth& truth;
};
using CycleObserver = std::function<void(const CycleRecord&)>;
using ReplyObserver = std::function<void(const OperatorReply&)>;

/// @throws std::runtime_error when the drives do not boot or the plant fails.
void run_in_process(const RunScript& script, const CycleObserver& on_cycle, const ReplyObserver& on_reply);

/// A command of this kind for cycle `at_seq`; the id is the cycle's number plus one.
OperatorCommand scripted(OperatorKind kind, std::int64_t at_seq);

}  // namespace sprung
