#pragma once
/// Rows `estimator.contact.<gait>.*` and `estimator.walk.<gait>.*`: what the estimate of a robot that walks
/// is worth against the simulation's truth. Contact of every step, and the gear output torque of every joint
/// with its bound.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/estimation/contact_scorer.h"
#include "tools/lab/estimation/estimator_score.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// A robot that stands up from lying flat and walks straight ahead.
struct WalkingEstimateRequest {
  std::string preset;  ///< empty = the robot's usual one
  std::string gait;    ///< of robot.yaml
  double forward_m_s = 0.0;
  double walking_s = 8.0;
  SimOptions sim;
};

struct WalkingEstimate {
  std::vector<ContactStep> steps;  ///< of every leg
  TorqueScore stance, swing;       ///< all joints of the legs that the planner has on the ground, in the air
  bool fits = true;                ///< the estimator has believed its models all the time

  void add(const WalkingEstimate& other);
};

/// @throws std::runtime_error where it does not stand up or does not walk to the end; std::invalid_argument
/// on a gait that the robot does not have.
WalkingEstimate walking_estimate(const RobotConfig& robot, const WalkingEstimateRequest& request);
/// Of contact found, delay_median, delay_p95 and false_alarms, with the bounds demanded of them; of torque
/// rms in stance and swing, coverage and half_width_over_rms of all, model_fits.
std::vector<ReportRow> walking_estimate_rows(const std::string& gait, const WalkingEstimate& found);

}  // namespace sprung
