#include "model/friction/friction_bound.h"

#include <cmath>

namespace sprung {

double two_sided_quantile(double probability) noexcept {
  // Bisection of erf(x / sqrt 2) = probability: done once, at start-up.
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erf(middle * 0.7071067811865476) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double friction_std_Nm(const FrictionValue& value, const FrictionUncertainty& uncertainty) noexcept {
  const double whole_Nm = uncertainty.relative * value.torque_Nm;
  double variance = whole_Nm * whole_Nm;
  for (std::size_t i = 0; i < kFrictionParameters; ++i) {
    const double part_Nm = value.gradient[i] * uncertainty.standard_errors[i];
    variance += part_Nm * part_Nm;
  }
  return std::sqrt(variance);
}

double friction_bound_Nm(const FrictionValue& value, const FrictionUncertainty& uncertainty,
                         double probability) noexcept {
  return two_sided_quantile(probability) * friction_std_Nm(value, uncertainty);
}

}  // namespace sprung
