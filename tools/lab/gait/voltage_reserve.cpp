#include "tools/lab/gait/voltage_reserve.h"

#include <cmath>

namespace sprung {
namespace {

/// The joint that a leg's actuator turns alone: the one entry of its row and column of the transmission.
int lone_joint(const LegConfig& leg, std::size_t place) {
  const std::size_t size = leg.actuators.size();
  for (std::size_t other = 0; other < size; ++other) {
    if (other == place) continue;
    if (leg.transmission[place * size + other] != 0.0 || leg.transmission[other * size + place] != 0.0)
      return -1;
  }
  return leg.transmission[place * size + place] == 1.0 ? leg.joints[place] : -1;
}

}  // namespace

VoltageReserveWatch::VoltageReserveWatch(const RobotConfig& robot, const SimOptions& sim) {
  const sim::SimConfig truth = sim::load_sim_config(robot, sim.plant);
  for (std::size_t i = 0; i < truth.drives.size(); ++i) {
    names_.push_back(robot.actuators[i].name);
    if (!truth.drives[i].winding) continue;
    watched_.push_back(watched(robot.actuators[i], truth.drives[i]));
    watched_.back().actuator = static_cast<int>(i);
    for (const LegConfig& leg : robot.legs)
      for (std::size_t place = 0; place < leg.actuators.size(); ++place)
        if (leg.actuators[place] == static_cast<int>(i)) watched_.back().joint = lone_joint(leg, place);
  }
}

VoltageReserveWatch::Watched VoltageReserveWatch::watched(const ActuatorConfig& actuator,
                                                          const sim::SimDriveConfig& drive) {
  Watched out;
  out.supply_V = drive.supply_V;
  out.copper_V_Nm = drive.winding->resistance_ohm / (actuator.gear_ratio * drive.torque_constant_Nm_A);
  out.emf_V_s_rad = actuator.gear_ratio *
                    drive.winding->back_emf_V_s_rad.value_or(drive.torque_constant_Nm_A);
  return out;
}

void VoltageReserveWatch::add(const SimTruth& truth) {
  for (const Watched& one : watched_) {
    if (one.joint < 0) continue;
    const TrueJoint& joint = truth.joints[static_cast<std::size_t>(one.joint)];
    const double winding_V = one.copper_V_Nm * joint.true_motor_torque_Nm +
                             one.emf_V_s_rad * joint.true_velocity_rad_s;
    if (std::isfinite(winding_V)) add(static_cast<std::size_t>(one.actuator), winding_V, one.supply_V);
  }
}

void VoltageReserveWatch::add(SimCore& sim) {
  const double common_V = sim.true_supply_V();
  for (const Watched& watched : watched_)
    add(static_cast<std::size_t>(watched.actuator), sim.true_winding_V(watched.actuator),
        std::isfinite(common_V) ? common_V : watched.supply_V);
}

void VoltageReserveWatch::add(std::size_t actuator, double winding_V, double supply_V) {
  const double reserve = 1.0 - std::abs(winding_V) / (kUsable * supply_V);
  if (reserve >= result_.least) return;  // never of NaN
  result_.least = reserve;
  result_.actuator = names_[actuator];
}

}  // namespace sprung
