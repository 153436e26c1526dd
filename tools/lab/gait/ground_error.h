#pragma once
/// `sprung experiment ground_error`: ground that lies up to 20 mm higher or lower than a foot expects. How
/// hard feet touch down with sprung's own pre-stance, with plain hybrid control and with the papers' soft
/// pre-stance; and who falls over it.
#include <string>
#include <vector>

#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/step_score.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct GroundCase {
  std::string name;  ///< of rows: rig, crawl
  std::string gait;
  double speed_m_s = 0.0;
  bool held = false;  ///< the trunk is fixed, at the preset's height over the expected floor
  double lasts_s = 0.0;
};

struct GroundOutcome {
  std::string name;
  GaitControl control = GaitControl::kAdaptive;
  std::vector<Touchdown> touchdowns;  ///< on ground that is in error
  WalkVitals vitals;
  double simulated_s = 0.0;
};

/// Steps of a height drawn within +-error_m under every footfall (sim.yaml's ground error), free body.
struct UnevenCase {
  std::string gait;
  double speed_m_s = 0.0;
  double error_m = 0.0;
  bool demanded = false;  ///< nobody may fall
};
struct UnevenOutcome {
  UnevenCase config;
  std::vector<WalkVitals> runs;
  double simulated_s = 0.0;
};

struct GroundErrorTask {
  std::string preset;  ///< empty = the robot's usual one
  SimOptions sim;
  std::uint64_t ground = 1;  ///< which grounds are drawn: the seed changes noise alone
  int grounds = 3;           ///< draws of uneven floor for each case
  ParallelOptions parallel;
};

struct GroundErrorResult {
  std::vector<GroundOutcome> touchdowns;
  std::vector<UnevenOutcome> uneven;
  double simulated_s = 0.0;
};

const std::vector<GroundCase>& ground_cases();
const std::vector<UnevenCase>& uneven_cases();

/// Under every footfall the ground is exactly 20 mm higher or lower, as `ground` says. Ends when the robot
/// falls.
GroundOutcome step_on_errors(const RobotConfig& robot, const GroundErrorTask& task, const GroundCase& config,
                             GaitControl control);
/// @param duration_s of walking. @param ground of the draw.
WalkVitals walk_uneven(const RobotConfig& robot, const GroundErrorTask& task, const UnevenCase& config,
                       std::uint64_t ground, double duration_s);

/// @throws CaseError where a simulation fails.
GroundErrorResult run_ground_error(const RobotConfig& robot, const GroundErrorTask& task);
/// Rows ground_error.*: pure. Ratios are of the worst touchdowns.
std::vector<ReportRow> ground_error_rows(const GroundErrorResult& result);
std::vector<report::Section> ground_error_sections(const GroundErrorResult& result);

Experiment ground_error_experiment();

}  // namespace sprung
