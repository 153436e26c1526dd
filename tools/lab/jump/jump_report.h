#pragma once
/// Jumps for people: S0's Figs. 10 to 12 drawn again from our data, with both torque signals, and every
/// figure beside the paper's. Pure.
#include "tools/common/report/report.h"
#include "tools/lab/jump/jump_experiment.h"

namespace sprung {

/// Sections only: title, seed, version and command are the caller's.
std::vector<report::Section> jump_sections(const RobotConfig& robot, const SimOptions& sim,
                                           const JumpExperiment& experiment);

/// One jump drawn: foot and both torques of each joint over its phases.
report::Section jump_figure(const MeasuredJump& jump, const std::vector<JumpSample>& samples);

}  // namespace sprung
