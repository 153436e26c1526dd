#pragma once
/// The plants that gains are tuned on, and others on which the outcome is reported. Pure.
#include <cstdint>
#include <vector>

#include "simulation/sim_core.h"

namespace sprung {

/// sim.yaml's own plant, then plants drawn evenly: friction within 20 %, mass 10 %, torque constant 5 % of
/// it, ground 6 to 12 kN/m.
/// @param seed of draws and noise. @param count at least 1.
std::vector<SimOptions> tune_plants(std::uint64_t seed, int count);

}  // namespace sprung
