#include "tools/lab/gait/voltage_reserve.h"

#include <cmath>

namespace sprung {

VoltageReserveWatch::VoltageReserveWatch(const RobotConfig& robot, const SimOptions& sim)
    : windings_(motor_windings(robot, sim)) {
  for (const ActuatorConfig& actuator : robot.actuators) names_.push_back(actuator.name);
}

void VoltageReserveWatch::add(const SimTruth& truth) {
  for (const MotorWinding& one : windings_) {
    if (one.joint < 0) continue;
    const TrueJoint& joint = truth.joints[static_cast<std::size_t>(one.joint)];
    const double winding_V = one.voltage_V(joint.true_motor_torque_Nm, joint.true_velocity_rad_s);
    if (std::isfinite(winding_V)) add(static_cast<std::size_t>(one.actuator), winding_V, one.supply_V);
  }
}

void VoltageReserveWatch::add(SimCore& sim) {
  const double common_V = sim.true_supply_V();
  for (const MotorWinding& one : windings_)
    add(static_cast<std::size_t>(one.actuator), sim.true_winding_V(one.actuator),
        std::isfinite(common_V) ? common_V : one.supply_V);
}

void VoltageReserveWatch::add(std::size_t actuator, double winding_V, double supply_V) {
  const double reserve = 1.0 - std::abs(winding_V) / (kUsable * supply_V);
  if (reserve >= result_.least) return;  // never of NaN
  result_.least = reserve;
  result_.actuator = names_[actuator];
}

}  // namespace sprung
