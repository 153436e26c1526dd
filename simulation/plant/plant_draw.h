#pragma once
/// `--plant draw=K` and `--plant family=NAME`: one plant of those that variation.yaml allows. Start-up only.
///
/// A draw is a function of robot, family and K alone: neither of the noise's seed nor of what else is drawn.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulation/plant/variation.h"

namespace sprung::sim {

/// A change `family=erob_100` is kept as the key "family.erob_100".
inline constexpr const char* kFamilyKey = "family.";

struct PlantDraw {
  std::string family;        ///< of friction; empty: sim.yaml's class, varied
  std::uint64_t number = 0;  ///< 0: nominal; of a family the middle of its spans
};

/// What the changes ask for and takes it out of them; nothing where they ask for none. @throws ConfigError on
/// a draw that is no whole number, and on two families.
std::optional<PlantDraw> take_draw(std::map<std::string, double>& changes);

struct DrawnValue {
  std::string item;  ///< body, joint or drive; empty: of the whole plant
  std::string quantity;
  double value = 0.0;
  std::string unit;
};

/// Changes `config`. @return what was drawn, in the order in which it was applied.
/// @throws ConfigError on a family that there is not, and on an IMU's spans where sim.yaml has none.
std::vector<DrawnValue> draw_plant(const RobotConfig& robot, const Variation& variation,
                                   const PlantDraw& draw, SimConfig& config);

}  // namespace sprung::sim
