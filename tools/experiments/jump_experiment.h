#pragma once
/// `sprung experiment jump`: one jump in each control mode on the same plant and seed, against the figures of
/// S0 (facts A2).
#include <string>

#include "drivers/sim/sim_core.h"
#include "robots/robot_config.h"
#include "tools/experiments/experiment_report.h"
#include "tools/experiments/scripted_run.h"

namespace sprung {

/// Stand, settle, jump `count` times in `mode`, stand again. Long enough for every mode of this preset.
RunScript jump_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      JumpMode mode, int count);

using ScriptRunner = std::function<void(const RunScript&, const CycleObserver&, const ReplyObserver&)>;

/// @param run run_in_process or the separate-process runner. @throws std::runtime_error where a command was
/// refused.
ExperimentReport run_jump_experiment(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run);

}  // namespace sprung
