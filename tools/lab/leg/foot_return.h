#pragma once
/// `sprung experiment foot_return`: a foot on a virtual spring is pulled away and released, with and without
/// friction compensation, in eight directions with five forces (S0 Figs. 8, 9), on the plant as identified
/// and on others (return_plant.h).
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/lab/leg/foot_return_score.h"
#include "tools/lab/leg/return_plant.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct FootReturnCase {
  std::string name;  ///< of rows: no spaces
  ReturnPlant plant;
  FootReturnScript script;
};

struct FootReturnCaseResult {
  FootReturnCase config;
  std::vector<PullResult> pulls;
  std::vector<PullTrace> traces;
  FootReturnSummary summary;
};

struct FootReturnResult {
  std::vector<FootReturnCaseResult> cases;
  double simulated_s = 0.0;
};

/// with and without at 2000 N/m, without at 500 N/m, with on other plants.
std::vector<FootReturnCase> foot_return_cases(const PresetConfig& preset);

/// Each case in runs of five pulls. @param parallel of the runs; separate processes want one job.
/// @throws std::runtime_error when the plant fails or a command is refused, std::invalid_argument for a robot
/// whose leg is not planar.
FootReturnResult run_foot_return(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                 const std::vector<FootReturnCase>& cases, const ScriptRunner& run,
                                 const ParallelOptions& parallel = {});

/// Rows foot_return.<case>.<mean|max|min|moved_least|...>, with the bounds.
std::vector<ReportRow> foot_return_rows(const FootReturnResult& result);

/// Of a robot that walks it is hanging_return.h.
Experiment foot_return_experiment();

}  // namespace sprung
