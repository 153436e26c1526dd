#include "tools/lab/tune/tune_search.h"

#include <algorithm>
#include <cmath>

namespace sprung {

namespace {

/// The root above 1 of x^(d+1) = x + 1: the golden ratio for d = 1.
double generalised_golden_ratio(std::size_t dimensions) {
  double root = 2.0;
  for (int i = 0; i < 64; ++i) root = std::pow(1.0 + root, 1.0 / (static_cast<double>(dimensions) + 1.0));
  return root;
}

double fraction(double value) { return value - std::floor(value); }

}  // namespace

UnitPoint even_point(std::size_t dimensions, std::size_t n) {
  const double ratio = generalised_golden_ratio(dimensions);
  UnitPoint point(dimensions);
  double step = 1.0;
  for (double& coordinate : point) {
    step /= ratio;
    coordinate = fraction(0.5 + step * static_cast<double>(n));
  }
  return point;
}

UnitPoint point_around(const UnitPoint& centre, double width, const UnitPoint& even) {
  UnitPoint point(centre.size());
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double low = std::clamp(centre[i] - 0.5 * width, 0.0, 1.0 - width);
    point[i] = low + width * even[i];
  }
  return point;
}

double refinement_width(int round) { return std::ldexp(0.5, -round); }

}  // namespace sprung
