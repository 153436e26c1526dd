#pragma once
/// Worst case of the traffic on every bus, from the profiles' own PDO maps, so that a robot whose frames do
/// not fit is refused before it is started. Frames count 55 + 10 n bits, every possible stuff bit there
/// (facts canopen 6.1). Pure; start-up only.
///
/// What counts, sustained for as long as one likes: SYNC; every PDO at SYNC by its type; set-points and,
/// since nothing keeps the state machine from changing its mind, the control word in every cycle; TPDOs on
/// change at their inhibit rate, in every cycle where they have none; heartbeats of the nodes, and the
/// bridge's in whole cycles; question and answer of a guarded node in whole cycles; background reads and
/// emergencies at the rates below. Not counted: error frames, repeats on the wire, and tools that read
/// objects.
#include <string>
#include <vector>

#include "robots/robot_config.h"

namespace sprung {

/// Above this, frames of low priority wait for more than a cycle (facts canopen 6.3: the usual ceiling is
/// 70-80 %).
inline constexpr double kMostBusLoad = 0.80;
inline constexpr double kSupplyReadsPerSecond = 1.0;  ///< of each drive, one SDO round trip each
inline constexpr double kModeReadsPerSecond = 20.0;   ///< of a drive that shows another mode than it was told
inline constexpr double kEmergenciesPerSecond = 10.0;  ///< of each node [design choice]

struct BusContribution {
  std::string what;          ///< "fl_hip_motor TPDO1"
  double bits_per_s = 0.0;   ///< at the worst
  double cyclic_bits = 0.0;  ///< the part that comes in every cycle as planned: SYNC, samples, set-points;
                             ///< bits of one cycle
};

struct BusLoad {
  std::string bus;
  double share = 0.0;                          ///< of the bus's time; 1 = full
  double cyclic_bits = 0.0;                    ///< of one cycle
  std::vector<BusContribution> contributions;  ///< largest first
};

struct BusLoadReport {
  std::vector<BusLoad> buses;  ///< in the order of RobotConfig::buses
};

/// @param watchdogs in force: they have the heartbeats' times. @throws std::invalid_argument from the
/// profiles.
BusLoadReport bus_load(const RobotConfig& robot, const WatchdogConfig& watchdogs);

/// "bus fl: 71 % worst case, 48.5 % in every cycle".
std::string bus_load_text(const RobotConfig& robot, const BusLoad& load);

/// @throws std::invalid_argument when a bus is above kMostBusLoad, naming it, its largest contributions and
/// what helps.
void check_bus_load(const RobotConfig& robot, const BusLoadReport& report);

}  // namespace sprung
