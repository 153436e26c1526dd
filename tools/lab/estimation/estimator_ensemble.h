#pragma once
/// The plants on which the estimator's bounds are held against the truth: friction within 25 %, torque
/// constant within 5 % and mass within 10 % of sim.yaml's. Pure.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "simulation/sim_core.h"

namespace sprung {

struct EnsemblePlant {
  std::string name;
  std::map<std::string, double> changes;  ///< for SimOptions::plant
  std::uint64_t seed = 0;                 ///< of the run's noise
};

/// sim.yaml's own plant, the eight corners, and twelve plants drawn evenly from the box.
/// @param ensemble which twelve are drawn: 0 was used to tune the estimator, any other is for reporting.
/// @param seed of the noise.
std::vector<EnsemblePlant> estimator_ensemble(std::uint64_t ensemble, std::uint64_t seed);

/// The ensemble about sim.yaml's plant. A plant that is changed already, or drawn, is not varied once more:
/// it is there five times, with noise of its own each time.
std::vector<EnsemblePlant> estimator_plants(const SimOptions& base, std::uint64_t ensemble);

}  // namespace sprung
