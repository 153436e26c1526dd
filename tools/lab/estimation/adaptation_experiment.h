#pragma once
/// What it buys to learn friction while the robot works (estimator/friction_adaptation.h): the same motion on
/// the same plant with learning on and off, and the gear's output torque against the truth once there was
/// something to learn from. A robot with gaits trots, or walks the last of its gaits; another one is hung up
/// and steps.
#include "tools/lab/estimation/estimator_score.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct AdaptationTask {
  std::string preset;
  SimOptions sim;
  double motion_s = 60.0;  ///< the last third is scored
};

struct AdaptationOutcome {
  TorqueScore torque;                                                               ///< all joints
  double least_dry = 1.0, most_dry = 1.0, least_viscous = 1.0, most_viscous = 1.0;  ///< factors at the end
  bool fits = true;  ///< every joint's model, at the end
  double simulated_s = 0.0;
};

/// @param learns `adapts_friction` of robot.yaml's `estimation`, whatever the file says.
/// @throws std::runtime_error where the robot does not move to the end.
AdaptationOutcome run_adaptation(RobotConfig robot, const AdaptationTask& task, bool learns);
/// Of both: RMS, share within the bounds, mean half-width; the ratios of on to off.
std::vector<ReportRow> adaptation_rows(const AdaptationOutcome& off, const AdaptationOutcome& on);

Experiment adaptation_experiment();

}  // namespace sprung
