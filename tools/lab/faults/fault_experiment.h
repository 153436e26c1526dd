#pragma once
/// Every fault on a standing robot (one without legs: idle), in one process: when it is noticed, what the
/// bridge makes of it, and whether `clear` and `stand` bring the robot back with no process restarted.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/vec3.h"
#include "simulation/sim_core.h"
#include "tools/lab/faults/fault_cases.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct FaultOutcome {
  FaultCase fault;
  std::string target;        ///< name of the actuator or bus
  double detected_s = kNaN;  ///< from the fault's cycle to the first reaction or count; NaN = never
  SafetyCause cause = SafetyCause::kNone;  ///< named by the bridge
  SafetyLevel worst = SafetyLevel::kOperational;
  double torque_off_s = kNaN;  ///< until no motor gives torque any more; NaN = some kept it, or none had any
  std::string counted;         ///< counters of BUS_STATE that grew, e.g. "missing_samples 12"
  bool cleared = false;        ///< `clear` ended with done (also where nothing was latched)
  double clear_s = kNaN;       ///< that it took
  std::string recovery;        ///< what it did to the node, or why it failed
  bool homed_again = false;    ///< a reference was lost, and found again
  bool referenced = true;      ///< every actuator, after the clear
  bool back = false;  ///< stands again with every actuator referenced, or is ready where there are no legs
};

/// @throws std::runtime_error where the robot does not even get up before the fault.
FaultOutcome run_fault(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                       const FaultCase& fault);

/// Rows faults.<case>.<detection|cause_as_expected|torque_off|back_after_clear>.
ExperimentReport fault_report(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                              const std::vector<FaultOutcome>& outcomes);
/// For people and for docs/drivers.md: a table in Markdown.
std::string fault_table(const std::vector<FaultOutcome>& outcomes);

}  // namespace sprung
