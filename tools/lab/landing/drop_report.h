#pragma once
/// Tables and plots of `sprung experiment drop`.
#include "tools/common/report/report.h"
#include "tools/lab/landing/drop_experiment.h"

namespace sprung {

/// One drop from 0.3 m in each mode is run again for the plots.
std::vector<report::Section> drop_sections(const RobotConfig& robot, const DropRequest& request,
                                           const DropExperiment& experiment, const ScriptRunner& run);

}  // namespace sprung
