#pragma once
/// The page that leads to every experiment's report and shows all their rows, and the same as JSON. Pure.
#include <string>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct IndexHeading {
  std::string robot;
  std::uint64_t robot_hash = 0;  ///< of robot.yaml: RobotConfig::hash
  std::uint64_t seed = 0;
  std::string command;  ///< that makes it all again
  double wall_s = 0.0;
};

/// Summary with a line for each experiment, then all of its rows, figures and tables.
report::Report experiment_index(const IndexHeading& heading,
                                const std::vector<FinishedExperiment>& experiments);

/// The report of one experiment, which the index calls <name>.html: alone or beside others, the same.
report::Report experiment_page(const IndexHeading& heading, const FinishedExperiment& experiment);

/// {"robot": ..., "experiments": [each as ExperimentReport::json(), with "failure"]}.
std::string experiment_index_json(const IndexHeading& heading,
                                  const std::vector<FinishedExperiment>& experiments);

/// A line for each experiment, for a terminal.
std::string experiment_index_text(const std::vector<FinishedExperiment>& experiments);

}  // namespace sprung
