#pragma once
/// How soon the estimator sees that its model is of another joint (estimator/model_watch.h): hung up, each
/// joint makes the moves of a guided recording, and the motion is counted until `model_fits` says no.
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/run/experiment.h"

namespace sprung {

struct WatchedJoint {
  std::string name;
  double motion_s = 0.0;  ///< of this joint, beyond kMoves_rad_s
  /// Motion before the model did not fit for the first time; 0: before any. Nothing: it fitted all the time.
  std::optional<double> misfit_after_s{};
  double simulated_s = 0.0;

  static constexpr double kMoves_rad_s = 0.1;
};

/// @param robot with the preset alone, where its presets differ in how they estimate.
/// @throws CaseError naming the joint's number where it cannot be moved.
std::vector<WatchedJoint> watch_models(const RobotConfig& robot, const SimOptions& sim,
                                       const ParallelOptions& parallel);
/// Of each joint the motion until it is said, NaN where it never is; of all of them the share of which it is
/// said within a second, and the share that fitted all the time.
std::vector<ReportRow> model_watch_rows(const std::vector<WatchedJoint>& joints);

Experiment model_watch_experiment();

}  // namespace sprung
