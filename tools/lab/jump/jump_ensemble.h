#pragma once
/// `sprung experiment jump_ensemble`: jumps of an asked height on plants that robot.yaml does not know, and
/// on ground from soft to hard: does the leg stay up, does safety trip, how high is the first jump, how high
/// the one after two that adapt.
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/modes.h"
#include "tools/common/parallel.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct JumpPlant {
  std::string name;
  std::map<std::string, double> changes;  ///< for SimOptions::plant
  std::uint64_t seed = 0;                 ///< of the run's noise
};

/// Drawn evenly: friction within 20 %, mass within 10 %, torque constant within 5 % of sim.yaml's, ground 6
/// to 12 kN/m.
/// @param ensemble which are drawn: 0 is for tuning, any other for reporting. @param seed of the noise.
std::vector<JumpPlant> jump_plants(std::uint64_t ensemble, std::uint64_t seed, int count);

/// sim.yaml's plant on ground of 5, 8.2, 15, 30 and 60 kN/m.
std::vector<JumpPlant> ground_sweep(std::uint64_t seed);

struct JumpOutcome {
  JumpPlant plant;
  bool fell = false;        ///< a jump did not land upright, or never came
  bool tripped = false;     ///< safety was not operational, or a command was refused or failed
  double first_mm = 0.0;    ///< height of the first jump; NaN where it did not land upright
  double adapted_mm = 0.0;  ///< of the third: after two that adapt
  double simulated_s = 0.0;
};

struct JumpEnsembleRequest {
  std::string preset;  ///< empty = the robot's usual one
  JumpMode mode = JumpMode::kHybrid;
  std::uint64_t seed = 1;
  int plants = 50;
  double height_m = 0.0;  ///< asked; 0: the height of the preset's own curve
  std::uint64_t ensemble = 1;
};

struct JumpEnsemble {
  double asked_mm = 0.0;
  double simulated_s = 0.0;
  std::vector<JumpOutcome> plants;
  std::vector<JumpOutcome> grounds;
};

/// One plant: stand, three jumps. In this process.
JumpOutcome jump_on(const RobotConfig& robot, const JumpEnsembleRequest& request, const JumpPlant& plant);

/// @throws CaseError where a simulation fails.
JumpEnsemble run_jump_ensemble(const RobotConfig& robot, const JumpEnsembleRequest& request,
                               const ParallelOptions& options = {});

/// Rows jump_ensemble.*: pure. Demands of issue 5: nobody falls, nothing trips, heights within 15 % after
/// adapting.
std::vector<ReportRow> jump_ensemble_rows(const JumpEnsemble& ensemble);

Experiment jump_ensemble_experiment();

}  // namespace sprung
