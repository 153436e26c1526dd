#include "tools/lab/gait/drawn_payload.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sprung {

std::map<std::string, double> drawn_payload(const RobotConfig& robot, double mass_kg, Dice& dice) {
  constexpr double kHigh_m = 0.15;
  std::array<double, 2> most_m{};
  for (const LegConfig& leg : robot.legs)
    for (std::size_t i = 0; i < 2; ++i) most_m[i] = std::max(most_m[i], std::abs(leg.hip_in_trunk_m[i]));
  const double x_m = most_m[0] * dice.between(-1.0, 1.0), y_m = most_m[1] * dice.between(-1.0, 1.0);
  return {{"payload", mass_kg}, {"payload_x", x_m}, {"payload_y", y_m}, {"payload_z", kHigh_m}};
}

}  // namespace sprung
