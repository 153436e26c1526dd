#include "robots/known_weight.h"

#include <algorithm>
#include <cmath>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

constexpr double kLoadShare = 0.2;
constexpr double kStep_kg = 0.5;

double reach_m(const LegConfig& leg) {
  double sum_m = 0.0;
  for (const LinkConfig& link : leg.links) sum_m += link.length_m;
  return sum_m;
}

}  // namespace

double known_weight_kg(const RobotConfig& robot, int joint) {
  for (const LegConfig& leg : robot.legs) {
    const auto found = std::find(leg.joints.begin(), leg.joints.end(), joint);
    const double reach = reach_m(leg);
    if (found == leg.joints.end() || !(reach > 0.0)) continue;
    const int actuator = leg.actuators[static_cast<std::size_t>(found - leg.joints.begin())];
    const double torque_Nm = kLoadShare * robot.actuators[static_cast<std::size_t>(actuator)].torque_limit_Nm;
    return std::max(1.0, std::floor(torque_Nm / (kGravity_m_s2 * reach) / kStep_kg)) * kStep_kg;
  }
  return 0.0;
}

}  // namespace sprung
