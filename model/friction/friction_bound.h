#pragma once
/// How wrong a friction torque may be, at a stated probability. Pure, no heap.
#include "model/friction/friction_law.h"

namespace sprung {

struct FrictionUncertainty {
  double relative = 0.0;             ///< one standard deviation of the whole law (another day, another unit)
  FrictionVector standard_errors{};  ///< of the parameters, in their units, as identified; uncorrelated
};

/// Number of standard deviations that holds `probability` of a normal distribution, either side: 0.95
/// -> 1.96.
/// @param probability in (0, 1). Slow (bisection): once, at start-up; in a loop multiply friction_std_Nm by
/// what it gave.
double two_sided_quantile(double probability) noexcept;

/// One standard deviation of the friction torque.
double friction_std_Nm(const FrictionValue& value, const FrictionUncertainty& uncertainty) noexcept;
/// Half-width that holds with this probability, where the sign of motion is known.
double friction_bound_Nm(const FrictionValue& value, const FrictionUncertainty& uncertainty,
                         double probability) noexcept;

}  // namespace sprung
