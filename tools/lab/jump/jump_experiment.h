#pragma once
/// `sprung experiment jump`: one jump in each control mode on the same plant and seed, against the figures of
/// S0 (facts A2), and beside them sprung's own landing under preset `best`.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/jump/jump_rows.h"
#include "tools/lab/jump/jump_trace.h"
#include "tools/lab/run/experiment_report.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

/// Stand, settle, jump `count` times in `mode`, stand again. Long enough for every mode of this preset.
RunScript jump_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      JumpMode mode, int count);

struct JumpExperiment {
  ExperimentReport rows;
  std::vector<MeasuredJump> jumps;
  std::vector<std::vector<JumpSample>> samples;  ///< of each of them
};

/// @param run run_in_process or the separate-process runner. @throws std::runtime_error where a command was
/// refused.
JumpExperiment run_jump_experiment(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                   const ScriptRunner& run);

}  // namespace sprung
