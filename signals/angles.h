#pragma once
/// Angles that every room needs, once.

namespace sprung {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn_rad = 2.0 * kPi;  ///< one full turn

}  // namespace sprung
