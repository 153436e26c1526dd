#pragma once
/// Every fault on a robot that stands (one without legs: idle) or moves, in one process: when it is noticed,
/// what the bridge makes of it, and whether `clear` and `stand` bring the robot back with no process
/// restarted.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/modes.h"
#include "signals/vec3.h"
#include "simulation/sim_core.h"
#include "tools/lab/faults/fault_motion.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct FaultCase {
  FaultKind kind = FaultKind::kNone;
  bool on_bus = false;      ///< the whole bus of the robot's last actuator, instead of that actuator's drive
  double value = 0.0;       ///< as FaultKind says
  double duration_s = 0.0;  ///< 0 = lasts until mended by itself, e.g. a power cycle
  SafetyCause cause = SafetyCause::kNone;  ///< that must be named; kNone = the robot goes on, the fault is
                                           ///< only counted
  double within_s = 0.0;  ///< from the fault to the reaction, or to the first count; NaN = the bus cannot
                          ///< show it
  bool back = true;       ///< `clear`, `home` where robot.yaml has a method, and `stand` bring the robot back
};

/// Limits are worked out from the robot's cycle and watchdogs.
std::vector<FaultCase> fault_cases(const RobotConfig& robot);

struct FaultOutcome {
  FaultCase fault;
  std::string motion = kNoMotion;
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

/// @param motion of fault_motions(). In one that is not standing the robot is on the floor, and may fall.
/// @throws std::runtime_error where the robot does not even get up or move before the fault.
FaultOutcome run_fault(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                       const FaultCase& fault, const std::string& motion = kNoMotion);

/// Rows faults.<case>.<detection|cause_as_expected|torque_off|back_after_clear>.
std::vector<ReportRow> fault_rows(const std::vector<FaultOutcome>& outcomes);
/// For people and for docs/drivers.md: a table in Markdown.
std::string fault_table(const std::vector<FaultOutcome>& outcomes);

Experiment faults_experiment();

}  // namespace sprung
