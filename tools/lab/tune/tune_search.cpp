#include "tools/lab/tune/tune_search.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "tools/lab/run/scoring.h"

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

namespace {

constexpr double kTunedFriction = 0.20, kTunedMass = 0.10, kTunedTorqueConstant = 0.05;  // issue 5's ensemble
constexpr double kSoftestTuned_N_m = 6000.0, kStiffest_N_m = 12000.0;

double about_one(std::mt19937_64& random, double width) { return 1.0 + width * even(random); }

}  // namespace

std::vector<SimOptions> tune_plants(std::uint64_t seed, int count) {
  if (count < 1) throw std::invalid_argument("--plants " + std::to_string(count) + ": expected 1 or more");
  std::mt19937_64 random(seed);
  std::vector<SimOptions> plants(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < plants.size(); ++i) {
    plants[i].seed = 1000 * seed + i + 1;
    if (i == 0) continue;
    plants[i].plant["friction_scale"] = about_one(random, kTunedFriction);
    plants[i].plant["mass_scale"] = about_one(random, kTunedMass);
    plants[i].plant["kt_scale"] = about_one(random, kTunedTorqueConstant);
    plants[i].plant["ground_stiffness"] = kSoftestTuned_N_m +
                                          (kStiffest_N_m - kSoftestTuned_N_m) * 0.5 * (even(random) + 1.0);
  }
  return plants;
}

}  // namespace sprung
