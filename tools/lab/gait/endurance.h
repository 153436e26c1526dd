#pragma once
/// `sprung experiment endurance`: minutes of an operator's commands at random on drawn plants, flat floor:
/// who falls, what trips.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct EnduranceRequest {
  std::string preset;      ///< empty = the robot's usual one
  std::uint64_t seed = 1;  ///< the first
  int seeds = 20;
  double minutes = 10.0;                ///< of each
  std::map<std::string, double> plant;  ///< changes over what is drawn
  ParallelOptions parallel;
};

struct EnduranceOutcome {
  std::uint64_t seed = 0;
  std::map<std::string, double> plant;
  WalkVitals vitals;
  std::string doing;  ///< when it fell or tripped first: the request; empty: it never did
  int requests = 0;
  int refusals = 0;
  double simulated_s = 0.0;
  double processor_s = 0.0;  ///< of one core
};

/// One seed, in this process; ends a second after a fall or trip.
EnduranceOutcome endure(const RobotConfig& robot, const EnduranceRequest& request, std::uint64_t seed);

/// @throws CaseError where a simulation fails, std::invalid_argument for what cannot be asked.
std::vector<EnduranceOutcome> run_endurance(const RobotConfig& robot, const EnduranceRequest& request);

/// Rows endurance.all.*: pure, the same bits whatever the machine does.
std::vector<ReportRow> endurance_rows(const std::vector<EnduranceOutcome>& outcomes);
report::Section endurance_section(const std::vector<EnduranceOutcome>& outcomes);
/// Simulated time over a core's time: a measurement of this machine, and so no row. NaN where nothing was
/// measured.
double endurance_speed(const std::vector<EnduranceOutcome>& outcomes) noexcept;

}  // namespace sprung
