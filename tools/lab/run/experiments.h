#pragma once
/// The table of experiments.
#include <vector>

#include "tools/lab/run/experiment.h"

namespace sprung {

/// All, in the order of `sprung experiment --help`, each with its own options at their defaults.
std::vector<Experiment> experiments();

/// Those that `sprung experiment all` runs: of a walker, of a leg that stands, or of a joint alone.
std::vector<Experiment> experiments_of(const RobotConfig& robot);

}  // namespace sprung
