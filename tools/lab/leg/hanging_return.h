#pragma once
/// `sprung experiment foot_return` of a walking robot: its trunk hangs, a hand pulls the left hind foot away
/// and lets go slowly (S1 Fig. 10), with and without friction compensation, on other plants
/// (return_plant.h).
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/leg/foot_disturbance.h"
#include "tools/lab/leg/foot_return_score.h"
#include "tools/lab/leg/return_plant.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct HangingCase {
  std::string name;  ///< of rows: no spaces
  std::string preset;
  ReturnPlant plant;
  StiffnessConfig gains;
  double friction_compensation = 0.0;
};

struct HangingPull {
  PullAndRelease hand;
  PullResult result;  ///< times from when the hand's force was gone; its pull's force is the hand's along the
                      ///< pull, held
  double sideways_mm = 0.0;  ///< of the foot at the end, out of the leg's plane
};

struct HangingCaseResult {
  HangingCase config;
  std::vector<HangingPull> pulls;
  std::vector<PullTrace> traces;  ///< of each pull, from when the hand's force was gone
  FootReturnSummary summary;
  double sideways_most_mm = 0.0;
};

struct HangingReturnResult {
  std::vector<HangingCaseResult> cases;
  double simulated_s = 0.0;
};

/// `with` the preset's own compensation; `without` and `paper` (preset paper, its compensation) on a plant of
/// the friction that S1's errors imply; `without_as_is` what `with` is, but for the compensation;
/// `with` on other plants.
/// On a drawn plant, which is another one already, `with` and `without_as_is` alone.
/// @param preset of all but `paper`.
std::vector<HangingCase> hanging_cases(const RobotConfig& robot, const std::string& preset, bool drawn);

/// @param pulls of each case, five of them to a run. @throws std::runtime_error, std::invalid_argument as
/// LeggedTrial.
HangingReturnResult run_hanging_return(const RobotConfig& robot, const SimOptions& sim,
                                       const std::vector<HangingCase>& cases,
                                       const std::vector<PullAndRelease>& pulls,
                                       const ParallelOptions& parallel = {});

/// Rows foot_return.<case>.<mean|max|min|...>, with issue 6's bounds.
std::vector<ReportRow> hanging_return_rows(const HangingReturnResult& result);

report::Section hanging_return_section(const HangingReturnResult& result);

}  // namespace sprung
