#pragma once
/// `sprung experiment step_response`: how fast the knee's torque follows, on the motor's side and at the
/// gear's output (S0's 4.75 ms; errata E9, E10).
///
/// thrust: the jump in position control, from its first set-point; 90 % and peak of the highest torque of the
/// push-off, since the motion goes on. rigid_floor, floor_like_gear: the hip is held so low that the floor,
/// without friction, keeps the foot kPressed_m short of the stand pose, where `comply` has its spring's other
/// end: a stiffer spring by a second `comply` is a step of the force from kBefore_N to kAfter_N. The foot is
/// under the hip, so that the knee alone moves. With the rigid floor the rotor makes 137 Hz. The other gives
/// as much as a gear's torsion would: single_leg's gears are rigid, so the rotor meets at the foot the spring
/// that errata E10 calculates with.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/vec3.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/leg/step_response_score.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

namespace step_response {
inline constexpr double kPressed_m = 0.02;
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

/// @param stand_length_m of the preset. @throws std::invalid_argument for a robot whose leg is not planar.
std::vector<StepCase> step_cases(const RobotConfig& robot, double stand_length_m);

/// @param parallel of the cases; separate processes want one job. @throws std::runtime_error when the plant
/// fails or a command is refused, std::invalid_argument for a robot whose leg is not planar and for a preset
/// that ramps stiffness.
StepResponseResult run_step_response(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run,
                                     const ParallelOptions& parallel = {});

/// Rows step_response.<motor|output>.<peak|t90> of the thrust, step_response.<case>.<motor|output>.<peak|t90>
/// of the others, in ms. "motor" is the papers' signal. Bounds are the papers' where they give any (S0's 4.75
/// ms, its 13 ms of ANYmal, errata E10).
std::vector<ReportRow> step_response_rows(const StepResponseResult& result);

Experiment step_response_experiment();

report::Section step_response_section(const StepResponseResult& result);

}  // namespace sprung
