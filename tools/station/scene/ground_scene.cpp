#include "tools/station/scene/ground_scene.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "robots/config_error.h"
#include "simulation/plant/ground.h"
#include "simulation/plant/sim_config.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

// [design choice] what a robot reaches from where it begins, most of them forward
constexpr double kFromX_m = -2.0, kToX_m = 12.0, kFromY_m = -2.5, kToY_m = 2.5, kSpacing_m = 0.05;

int count(double from_m, double to_m) {
  return static_cast<int>(std::lround((to_m - from_m) / kSpacing_m)) + 1;
}

Json heights_mm(const sim::Ground& ground) {
  Json out = Json::array();
  for (int line = 0; line < count(kFromY_m, kToY_m); ++line)
    for (int column = 0; column < count(kFromX_m, kToX_m); ++column) {
      const sim::Ground::Place place = ground.below(kFromX_m + column * kSpacing_m,
                                                    kFromY_m + line * kSpacing_m);
      out.push_back(std::lround(1e3 * place.point_m[2]));
    }
  return out;
}

Json patches(const sim::GroundConfig& config) {
  Json out = Json::array();
  for (const sim::GroundPatch& patch : config.patches)
    out.push_back({{"from_m", patch.area.from_m},
                   {"length_m", patch.area.length_m},
                   {"right_m", patch.area.right_m},
                   {"width_m", patch.area.width_m},
                   {"friction", patch.friction}});
  return out;
}

}  // namespace

Json ground_scene(const RobotConfig& robot, const std::map<std::string, double>& asked) {
  try {
    const sim::PlantConfig plant = sim::load_sim_config(robot, asked).plant;
    const sim::Ground ground(plant.ground, plant.floor_height_m, robot.legs.size());
    if (!ground.uneven() && !ground.slippery_in_places()) return nullptr;
    return {{"from_m", {kFromX_m, kFromY_m}},     {"spacing_m", kSpacing_m},
            {"columns", count(kFromX_m, kToX_m)}, {"lines", count(kFromY_m, kToY_m)},
            {"heights_mm", heights_mm(ground)},   {"patches", patches(plant.ground)}};
  } catch (const ConfigError&) {
    return nullptr;
  }
}

}  // namespace sprung::station
