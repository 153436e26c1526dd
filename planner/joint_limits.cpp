#include "planner/joint_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/torque_limits.h"
#include "model/transmission.h"

namespace sprung {
namespace {

/// Largest factor on `each` that keeps every actuator's share below its limit.
double largest(const JointVector& each, const RobotConfig& robot, const LegConfig& leg,
               double ActuatorConfig::*limit) {
  double factor = std::numeric_limits<double>::infinity();
  for (int i = 0; i < each.size(); ++i) {
    const auto actuator = static_cast<std::size_t>(leg.actuators[static_cast<std::size_t>(i)]);
    if (each[i] != 0.0) factor = std::min(factor, robot.actuators[actuator].*limit / std::abs(each[i]));
  }
  return factor;
}

}  // namespace

std::vector<JointLimits> joint_limits(const RobotConfig& robot) {
  std::vector<JointLimits> out(robot.joints.size());
  for (const LegConfig& leg : robot.legs) {
    const Transmission transmission(leg);
    for (int j = 0; j < transmission.size(); ++j) {
      const auto index = static_cast<std::size_t>(leg.joints[static_cast<std::size_t>(j)]);
      const JointConfig& joint = robot.joints[index];
      const JointVector unit = JointVector::Unit(transmission.size(), j);
      const JointVector torque_Nm_s2_rad = transmission.actuator_torque(joint.armature_kg_m2 * unit);
      out[index] = {
          joint.position_min_rad + kPositionMargin_rad, joint.position_max_rad - kPositionMargin_rad,
          largest(transmission.actuator_from_joint(unit), robot, leg, &ActuatorConfig::speed_limit_rad_s),
          largest(torque_Nm_s2_rad, robot, leg, &ActuatorConfig::torque_limit_Nm)};
    }
  }
  return out;
}

}  // namespace sprung
