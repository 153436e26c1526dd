#pragma once
/// `sprung experiment fall`: pushes that throw the robot over, each on another drawn plant, once with legs
/// that meet the fall (planner/fall_reflex.h) and once with legs that are damped alone.
#include <string>
#include <vector>

#include "simulation/sim_core.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/push_experiment.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct FallCase {
  std::string gait;
  double speed_m_s = 0.0;
  double impulse_Ns = 0.0;
  PushDirection direction = PushDirection::kLeft;
  double draw = 0.0;  ///< of variation.yaml
};

/// What one robot went through.
struct FallOutcome {
  WalkVitals vitals;
  double trunk_peak_N = 0.0;  ///< ground on the trunk itself, largest of all cycles
  double gear_peak_Nm = 0.0;  ///< at any gear's output
  /// Since the push: when the planner noticed, and when the ground met the trunk; NaN: never.
  double noticed_s = kNaN, down_s = kNaN;
  double simulated_s = 0.0;
  bool unnoticed() const noexcept { return vitals.fell && !vitals.caught; }
};

struct FallPair {
  FallCase config;
  FallOutcome met, damped;
};

/// Every gait of the robot, two impulses by its mass, four directions; draws from that of `first` upward.
std::vector<FallCase> fall_cases(const RobotConfig& robot, double first_draw);

/// Stands up, walks, is pushed over 0.1 s, and is watched for kWatched_s.
FallOutcome fall_once(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      const FallCase& config);

/// fall.*: means over the pairs in which both fell, ratios of the means; falls that the planner did not
/// notice. Pure. @param foreseen by an IMU: else no fall is met, and nothing is demanded of the ratio.
std::vector<ReportRow> fall_rows(const std::vector<FallPair>& pairs, bool foreseen = true);

Experiment fall_experiment();

}  // namespace sprung
