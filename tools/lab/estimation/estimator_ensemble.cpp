#include "tools/lab/estimation/estimator_ensemble.h"

#include <array>
#include <random>

#include "tools/lab/run/scoring.h"

namespace sprung {
namespace {

constexpr double kFriction = 0.25, kTorqueConstant = 0.05, kMass = 0.10;
constexpr int kDraws = 12;
constexpr std::uint64_t kRepetitions = 5;  ///< of a plant that is not varied

/// @param at where in the box, each in [-1, 1].
std::map<std::string, double> changes(const std::array<double, 3>& at) {
  return {{"friction_scale", 1.0 + kFriction * at[0]},
          {"kt_scale", 1.0 + kTorqueConstant * at[1]},
          {"mass_scale", 1.0 + kMass * at[2]}};
}

}  // namespace

std::vector<EnsemblePlant> estimator_ensemble(std::uint64_t ensemble, std::uint64_t seed) {
  std::vector<EnsemblePlant> plants;
  const auto add = [&](const std::string& name, const std::array<double, 3>& at) {
    plants.push_back({name, changes(at), 1000 * seed + plants.size() + 1});
  };
  add("nominal", {0.0, 0.0, 0.0});
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<double, 3> at{};
    std::string name = "corner_";
    for (unsigned i = 0; i < 3; ++i) {
      const bool high = (corner >> i & 1U) != 0;
      at[i] = high ? 1.0 : -1.0;
      name += high ? 'h' : 'l';
    }
    add(name, at);
  }
  std::mt19937_64 random(ensemble);
  for (int i = 0; i < kDraws; ++i) {
    std::array<double, 3> at{};
    for (double& part : at) part = even(random);
    add("draw_" + std::to_string(i + 1), at);
  }
  return plants;
}

std::vector<EnsemblePlant> estimator_plants(const SimOptions& base, std::uint64_t ensemble) {
  if (base.plant.empty()) return estimator_ensemble(ensemble, base.seed);
  std::vector<EnsemblePlant> plants;
  for (std::uint64_t run = 1; run <= kRepetitions; ++run)
    plants.push_back({"run_" + std::to_string(run), base.plant, 1000 * base.seed + run});
  return plants;
}

}  // namespace sprung
