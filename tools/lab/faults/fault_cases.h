#pragma once
/// The faults that `sprung experiment faults` makes, one after the other, and what must follow from each
/// (docs/drivers.md holds the measured table).
#include <vector>

#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung {

struct FaultCase {
  FaultKind kind = FaultKind::kNone;
  bool on_bus = false;      ///< the whole bus of the robot's last actuator, instead of that actuator's drive
  double value = 0.0;       ///< as FaultKind says
  double duration_s = 0.0;  ///< 0 = lasts until mended by itself, e.g. a power cycle
  SafetyCause cause =
      SafetyCause::kNone;  ///< that must be named; kNone = the robot goes on, the fault is only counted
  double within_s =
      0.0;           ///< from the fault to the reaction, or to the first count; NaN = the bus cannot show it
  bool back = true;  ///< `clear`, `home` where robot.yaml has a method, and `stand` bring the robot back
};

/// Limits are worked out from the robot's cycle and watchdogs.
std::vector<FaultCase> fault_cases(const RobotConfig& robot);

}  // namespace sprung
