#pragma once
/// The table of experiments.
#include <vector>

#include "tools/lab/run/experiment.h"

namespace sprung {

/// All, in the order of `sprung experiment --help`, each with its own options at their defaults.
std::vector<Experiment> experiments();

/// Those that `sprung experiment all` runs. @throws std::invalid_argument with the reason where the robot's
/// legs cannot stand: all of these need one that does.
std::vector<Experiment> experiments_of(const RobotConfig& robot);

}  // namespace sprung
