#pragma once
/// `sprung experiment step_response`: how fast the knee's torque follows, on the motor's side and at the gear's output (S0's 4.75 ms;
/// errata E9, E10).
///
/// thrust: the jump in position control, from its first set-point; 90 % and peak of the highest torque of the push-off, since
/// the motion goes on.
/// rigid_floor, floor_like_gear: the hip hangs fixed, the foot presses on a floor without friction, so that the knee alone moves, and in
/// torque compliance without stiffness the force asked of the foot steps from kBefore_N to kAfter_N. With the rigid floor the rotor makes
/// 134 Hz. The other gives as much as a gear's torsion would: single_leg's gears are rigid, so the rotor meets at the
/// foot the spring that errata E10 calculates with.
#include <string>
#include <vector>

#include "drivers/sim/sim_core.h"
#include "robots/robot_config.h"
#include "tools/experiments/experiment_report.h"
#include "tools/experiments/jump_experiment.h"
#include "tools/experiments/step_response_score.h"

namespace sprung {

namespace step_response {
inline constexpr double kBefore_N = 100.0;
inline constexpr double kAfter_N = 300.0;
inline constexpr double kRigidFloor_N_m = 1e7;
inline constexpr double kGear_Nm_rad = 4.1e4;  ///< E10: 3.1e4 to 5e4 at a ratio of 100
}  // namespace step_response

struct StepCase {
  std::string name;         ///< of rows: no spaces
  bool locked = true;       ///< false: thrust
  double floor_N_m = kNaN;  ///< stiffness; NaN: as in sim.yaml
};

struct StepResult {
  StepCase config;
  StepTrace knee;
  StepFigures estimated_motor_side;
  StepFigures motor;
  StepFigures output;
};

struct StepResponseResult {
  std::vector<StepResult> cases;
  double simulated_s = 0.0;
};

/// @param leg_length_m of the leg that stands on the floor. @throws std::invalid_argument for a robot whose leg is not planar.
std::vector<StepCase> step_cases(const RobotConfig& robot, double leg_length_m);

/// @throws std::runtime_error when the plant fails, std::invalid_argument for a robot whose leg is not planar.
StepResponseResult run_step_response(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run);

/// Rows step_response.<motor|output>.<peak|t90> of the thrust, step_response.<case>.<motor|output>.<peak|t90> of the others, in ms.
/// "motor" is the papers' signal.
std::vector<ReportRow> step_response_rows(const StepResponseResult& result);

}  // namespace sprung
