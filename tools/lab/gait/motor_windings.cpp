#include "tools/lab/gait/motor_windings.h"

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

int joint_of(const RobotConfig& robot, int actuator) {
  for (const LegConfig& leg : robot.legs)
    for (std::size_t place = 0; place < leg.actuators.size(); ++place)
      if (leg.actuators[place] == actuator) return lone_joint(leg, place);
  return -1;
}

}  // namespace

std::vector<MotorWinding> motor_windings(const RobotConfig& robot, const SimOptions& sim) {
  const sim::SimConfig truth = sim::load_sim_config(robot, sim.plant);
  std::vector<MotorWinding> out;
  for (std::size_t i = 0; i < truth.drives.size(); ++i) {
    const sim::SimDriveConfig& drive = truth.drives[i];
    if (!drive.winding) continue;
    const double ratio = robot.actuators[i].gear_ratio;
    MotorWinding one;
    one.actuator = static_cast<int>(i);
    one.joint = joint_of(robot, one.actuator);
    one.supply_V = drive.supply_V;
    one.current_A_Nm = 1.0 / (ratio * drive.torque_constant_Nm_A);
    one.copper_V_Nm = drive.winding->resistance_ohm * one.current_A_Nm;
    one.emf_V_s_rad = ratio * drive.winding->back_emf_V_s_rad.value_or(drive.torque_constant_Nm_A);
    out.push_back(one);
  }
  return out;
}

}  // namespace sprung
