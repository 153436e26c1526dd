#pragma once
/// The experiments that `sprung experiment all` runs: one entry each, all by the same call.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/common/report/report.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct ExperimentInput {
  RobotConfig robot;
  std::uint64_t seed = 1;  ///< of every noise and of drawn plants
  int jobs = 0;            ///< threads that it may use
};

struct ExperimentOutput {
  ExperimentReport rows;
  std::vector<report::Section> sections;  ///< its figures and tables; may be empty
};

struct ExperimentEntry {
  std::string name;      ///< as in `sprung experiment <name>`
  std::string preset;    ///< under which it is run
  std::string question;  ///< that it answers, for people
  bool many_cases;       ///< uses all the threads by itself
  std::function<ExperimentOutput(const ExperimentInput&)> run;

  /// The line that runs it alone.
  std::string command(const std::string& robot, std::uint64_t seed) const;
};

/// In the order of the index page. @throws std::invalid_argument with the reason where the robot's legs
/// cannot stand: all these experiments need one that does.
std::vector<ExperimentEntry> experiments_of(const RobotConfig& robot);

}  // namespace sprung
