#pragma once
/// walking_experiments.h as `sprung experiment all` runs them.
#include <vector>

#include "tools/lab/run/experiment_registry.h"

namespace sprung {

/// All under `preset`. endurance is short here: a minute of each seed; the command alone takes ten.
std::vector<ExperimentEntry> gait_entries(const std::string& preset);

}  // namespace sprung
