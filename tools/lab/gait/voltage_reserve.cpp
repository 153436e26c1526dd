#include "tools/lab/gait/voltage_reserve.h"

#include <cmath>

#include "simulation/plant/sim_config.h"

namespace sprung {

VoltageReserveWatch::VoltageReserveWatch(const RobotConfig& robot, const SimOptions& sim) {
  const sim::SimConfig truth = sim::load_sim_config(robot, sim.plant);
  for (std::size_t i = 0; i < truth.drives.size(); ++i) {
    names_.push_back(robot.actuators[i].name);
    if (truth.drives[i].winding) watched_.push_back({static_cast<int>(i), truth.drives[i].supply_V});
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
