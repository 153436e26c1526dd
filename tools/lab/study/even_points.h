#pragma once
/// Points that fill a box evenly, however many are taken, and no chance in it. Pure.
#include <cstddef>
#include <vector>

namespace sprung {

using UnitPoint = std::vector<double>;  ///< each coordinate within 0 ... 1

/// The n-th point, from 0, of Roberts' additive sequence R_d ("The unreasonable effectiveness of quasirandom
/// sequences", 2018).
UnitPoint even_point(std::size_t dimensions, std::size_t n);

}  // namespace sprung
