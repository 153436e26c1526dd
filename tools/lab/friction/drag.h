#pragma once
/// `sprung experiment drag`: the link is moved from outside by a hand, the stack's torque estimate against
/// the torque sensor (S0 section II-A, Fig. 6).
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/friction/drag_score.h"
#include "tools/lab/friction/drag_script.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// What happened beside the torques, every cycle.
struct DragTrace {
  std::vector<double> time_s;
  std::vector<double> angle_rad;       ///< estimated
  std::vector<double> hand_angle_rad;  ///< NaN where nobody touches the link
  std::vector<double> hand_torque_Nm;
};

struct DragPhaseResult {
  std::string name;
  double from_s = 0.0;
  double to_s = 0.0;
  std::vector<DragSample> samples;
  DragScore score;
};

struct DragResult {
  std::string robot;
  std::string joint;
  std::uint64_t seed = 0;
  bool sensed = false;   ///< reference is the bench's torque sensor; else SIM_TRUTH
  std::string friction;  ///< what the estimator was told, and from where
  double simulated_s = 0.0;
  std::vector<DragPhaseResult> phases;
  DragScore all;
  DragTrace trace;
};

/// @throws std::runtime_error when the robot refuses a move or the plant fails.
DragResult run_drag(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int joint);

/// The same robot with this joint's friction as the loaded sweep of another seed finds it.
RobotConfig with_swept_friction(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                int joint);

/// Rows <prefix>.<phase>.<rms|max|coverage|half_width|paper_rms>, and the same of all phases together.
std::vector<ReportRow> drag_rows(const DragResult& result, const std::string& prefix);

Experiment drag_experiment();

}  // namespace sprung
