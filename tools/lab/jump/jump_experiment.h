#pragma once
/// `sprung experiment jump`: one jump in each control mode on the same plant and seed, against the figures of
/// S0 (facts A2), and beside them adaptive landing under preset `best`.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/jump/jump_rows.h"
#include "tools/lab/jump/jump_trace.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

inline constexpr JumpMode kJumpModes[] = {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid,
                                          JumpMode::kAdaptive};

/// Stand, settle, jump `count` times in `mode`, stand again. Long enough for every mode of this preset.
RunScript jump_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      JumpMode mode, int count);

struct JumpExperiment {
  std::string preset;  ///< of the papers' three
  std::vector<ReportRow> rows;
  std::vector<MeasuredJump> jumps;
  std::vector<std::vector<JumpSample>> samples;  ///< of each of them
  double simulated_s = 0.0;
};

/// @param run run_in_process or the separate-process runner. @param mode one of kJumpModes, or "all".
/// @throws std::runtime_error where a command was refused.
JumpExperiment run_jump_experiment(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                   const ScriptRunner& run, const std::string& mode = "all");

Experiment jump_experiment();

}  // namespace sprung
