#pragma once
/// `sprung experiment parameters`: every parameter that may change while the robot runs (robots/parameters.h)
/// is set to each end of its range while the robot complies, stands on its springs and trots. Does it fall,
/// and does a torque step?
#include <string>
#include <vector>

#include "robots/parameters.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// What the robot does meanwhile.
enum class ParameterMotion { kComply, kStand, kTrot };
constexpr auto words_of(ParameterMotion) {
  using E = ParameterMotion;
  return words<E>({{E::kComply, "comply"}, {E::kStand, "stand"}, {E::kTrot, "trot"}});
}

struct ParameterTrial {
  ParameterMotion motion = ParameterMotion::kStand;
  std::int64_t parameter = 0;  ///< its id
  std::string name;
  double value = 0.0;
  bool refused = false;  ///< by the planner
  bool fell = false;
  int trips = 0;
  /// Largest change of a motor's torque in a cycle, over what it changes in that cycle where nothing is set;
  /// share of the actuator's limit. Complying and standing: in the 2 s from the cycle in which it took
  /// effect; in a trot in the first 0.1 s, after which the feet land at other times.
  double worst_step = 0.0;
};

/// @param names those alone; empty: all. @throws as WalkingRobot.
std::vector<ParameterTrial> run_parameter_trials(const RobotConfig& robot, const std::string& preset,
                                                 const SimOptions& sim, const std::vector<std::string>& names,
                                                 const ParallelOptions& parallel = {});

/// Rows parameters.<motion>.<falls|trips|refused|worst_step>.
std::vector<ReportRow> parameter_rows(const std::vector<ParameterTrial>& trials);

Experiment parameter_experiment();

}  // namespace sprung
