#pragma once
/// `sprung experiment stand_push`: a walking robot stands free on its feet and is pounded, pushed down and
/// lifted, once in position control and once on its virtual springs (gait `stand`): what hip and knee carry
/// above their static torque (S1 Fig. 11).
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/lab/gait/stand_push_score.h"
#include "tools/lab/gait/trunk_hand.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct PushRun {
  PushScore score;
  std::vector<PushSample> samples;
};

struct PushPair {
  TrunkPush push;
  PushRun position, compliance;
};

struct StandPushResult {
  std::vector<PushPair> pushes;
  StiffnessConfig gains;                                                    ///< of the standing feet, and
  double friction_compensation = 0.0;                                       ///< theirs
  double position_stiffness_Nm_rad = 0.0, position_damping_Nm_s_rad = 0.0;  ///< of the knees' position loops
  double simulated_s = 0.0;
};

/// @throws std::runtime_error, std::invalid_argument as LeggedTrial.
StandPushResult run_stand_push(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                               const std::vector<TrunkPush>& pushes, const ParallelOptions& parallel = {});

/// Rows stand_push.<push>.<ratio|...>, with issue 6's bounds. `ratio` is of the papers' joint torque, which
/// is the motor's (S1 had no torque sensor); `output_ratio` of the gear's true output, beside it: what a
/// pound puts through the legs to the floor passes every gear whatever the control, since rotors and friction
/// hold the joints (docs/locomotion.md "Standing, pushed").
std::vector<ReportRow> stand_push_rows(const StandPushResult& result);

Experiment stand_push_experiment();

}  // namespace sprung
