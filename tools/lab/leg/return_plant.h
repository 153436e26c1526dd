#pragma once
/// Plants on which a foot is let go: not the one that robot.yaml was identified on. Pure.
#include <string>
#include <utility>
#include <vector>

#include "simulation/sim_core.h"
#include "tools/common/report/report.h"

namespace sprung {

/// Each times what SimOptions ask for.
struct ReturnPlant {
  double friction_scale = 1.0;
  double mass_scale = 1.0;
  double kt_scale = 1.0;  ///< torque constant
  bool drawn = false;     ///< of variation.yaml besides, whatever that changes
  bool as_identified() const {
    return !drawn && friction_scale == 1.0 && mass_scale == 1.0 && kt_scale == 1.0;
  }
};

/// Of a case `with` compensation, by name: friction 10 and 20 % off, masses 10 %, torque constants 5 %, and
/// all of them at once so that they add up to the most and the least that is compensated too little.
inline std::vector<std::pair<std::string, ReturnPlant>> other_return_plants() {
  return {{"with_friction_80", {0.8, 1.0, 1.0}},  {"with_friction_90", {0.9, 1.0, 1.0}},
          {"with_friction_110", {1.1, 1.0, 1.0}}, {"with_friction_120", {1.2, 1.0, 1.0}},
          {"with_mass_90", {1.0, 0.9, 1.0}},      {"with_mass_110", {1.0, 1.1, 1.0}},
          {"with_kt_95", {1.0, 1.0, 0.95}},       {"with_kt_105", {1.0, 1.0, 1.05}},
          {"with_least", {0.8, 0.9, 1.05}},       {"with_most", {1.2, 1.1, 0.95}}};
}

/// As tables show it.
inline std::string plant_text(const ReturnPlant& plant) {
  return report::number_text(plant.friction_scale) + ", " + report::number_text(plant.mass_scale) + ", " +
         report::number_text(plant.kt_scale);
}

/// Demanded on these.
inline constexpr double kOtherMean_mm = 2.0, kOtherMax_mm = 4.0;

inline SimOptions on_plant(SimOptions sim, const ReturnPlant& plant) {
  for (const auto& [key, scale] :
       {std::pair{"friction_scale", plant.friction_scale}, std::pair{"mass_scale", plant.mass_scale},
        std::pair{"kt_scale", plant.kt_scale}}) {
    if (scale != 1.0) sim.plant.emplace(key, 1.0).first->second *= scale;
  }
  return sim;
}

}  // namespace sprung
