#pragma once
/// The experiments on a robot in a gait, all by one call: for the command line and for `sprung experiment
/// all`.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct WalkingInput {
  RobotConfig robot;
  std::string preset;  ///< empty = the robot's usual one
  std::uint64_t seed = 1;
  std::map<std::string, double> plant;
  int seeds = 20;            ///< endurance: how many, from `seed` on
  double minutes = 10.0;     ///< endurance: of each
  double distance_m = 10.0;  ///< walk: over which speed and drift are taken
  ParallelOptions parallel;
};

struct WalkingOutput {
  ExperimentReport rows;
  std::vector<report::Section> sections;
  std::string remark;  ///< for people, after the rows: what depends on the machine; may be empty
};

struct WalkingExperiment {
  std::string name;
  std::string what;      ///< for --help
  std::string question;  ///< that it answers
  WalkingOutput (*run)(const WalkingInput& input);
};

/// walk, ground_error, push, endurance.
const std::vector<WalkingExperiment>& gait_experiments();

}  // namespace sprung
