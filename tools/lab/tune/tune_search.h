#pragma once
/// Where a search looks: points that fill a box evenly, then ever smaller boxes around the best. Pure; no
/// chance in it.
#include <cstddef>
#include <vector>

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

}  // namespace sprung
