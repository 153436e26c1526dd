#include "tools/lab/tune/tune_plants.h"

#include <random>
#include <stdexcept>
#include <string>

namespace sprung {

namespace {

constexpr double kFriction = 0.20, kMass = 0.10, kTorqueConstant = 0.05;  // issue 5's ensemble
constexpr double kSoftest_N_m = 6000.0, kStiffest_N_m = 12000.0;

/// Of [0, 1); the same on every machine, which std::uniform_real_distribution does not promise.
double even(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double about_one(std::mt19937_64& random, double width) { return 1.0 + width * (2.0 * even(random) - 1.0); }

}  // namespace

std::vector<SimOptions> tune_plants(std::uint64_t seed, int count) {
  if (count < 1) throw std::invalid_argument("--plants " + std::to_string(count) + ": expected 1 or more");
  std::mt19937_64 random(seed);
  std::vector<SimOptions> plants(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < plants.size(); ++i) {
    plants[i].seed = 1000 * seed + i + 1;
    if (i == 0) continue;
    plants[i].plant["friction_scale"] = about_one(random, kFriction);
    plants[i].plant["mass_scale"] = about_one(random, kMass);
    plants[i].plant["kt_scale"] = about_one(random, kTorqueConstant);
    plants[i].plant["ground_stiffness"] = kSoftest_N_m + (kStiffest_N_m - kSoftest_N_m) * even(random);
  }
  return plants;
}

}  // namespace sprung
