#include "tools/lab/study/even_points.h"

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

}  // namespace sprung
