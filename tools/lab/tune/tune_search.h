#pragma once
/// Where a search looks: points that fill a box evenly, then ever smaller boxes around the best, no chance in
/// it; and on which plants. Pure.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulation/sim_core.h"

namespace sprung {

using UnitPoint = std::vector<double>;  ///< each coordinate within 0 ... 1

/// The n-th point, from 0, of Roberts' additive sequence R_d ("The unreasonable effectiveness of quasirandom
/// sequences", 2018): however many are taken, they fill the box evenly.
UnitPoint even_point(std::size_t dimensions, std::size_t n);

/// The same point in a box with edges of `width` (0 ... 1) around `centre`, pushed to lie within the unit
/// box.
UnitPoint point_around(const UnitPoint& centre, double width, const UnitPoint& even);

/// Width of the boxes of refinement round 0, 1, ...: a half of the range, a quarter, ...
double refinement_width(int round);

/// sim.yaml's own plant, then plants drawn evenly: friction within 20 %, mass 10 %, torque constant 5 % of
/// it, ground 6 to 12 kN/m.
/// @param seed of draws and noise. @param count at least 1.
std::vector<SimOptions> tune_plants(std::uint64_t seed, int count);

}  // namespace sprung
