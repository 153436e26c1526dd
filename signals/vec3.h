#pragma once
/// Three numbers along axes, and what stands for "not known".
#include <array>
#include <limits>

namespace sprung {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Vec3 = std::array<double, 3>;

}  // namespace sprung
