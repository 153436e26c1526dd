#pragma once
/// `sprung experiment estimator`: the overall table of what the estimate is worth, against truth and
/// recordings.
#include <cstdint>
#include <functional>
#include <string>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct EstimatorRequest {
  std::string robot = "test_axis";  ///< test_axis: the whole table; another: the rows that this robot gives
  std::string preset;               ///< empty = the robot's usual one
  std::uint64_t seed = 1;           ///< 0 was used to tune the estimator
  std::string data;  ///< folder of recordings; "" = /work/shared/data or ../shared/data where one is
  std::string only;  ///< "" = all; else one section: see estimator_sections()
};

/// Names of the table's sections, one line each, for --help and for errors.
std::string estimator_sections();

/// Told before each section how many of how many are done.
using SectionProgress = std::function<void(std::size_t done, std::size_t count)>;

/// @throws ConfigError, std::invalid_argument on a request that cannot be, std::runtime_error where a run
/// fails.
ExperimentReport run_estimator_experiment(const EstimatorRequest& request,
                                          const SectionProgress& on_progress = {});

}  // namespace sprung
