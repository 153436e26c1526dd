#pragma once
/// Runs every experiment of a robot, several at a time. One that fails does not stop the others.
#include <functional>
#include <string>
#include <vector>

#include "tools/lab/run/experiment_registry.h"

namespace sprung {

struct FinishedExperiment {
  ExperimentEntry entry;
  ExperimentOutput output;
  std::string failure;  ///< why it has no rows; empty: it ran

  bool ok() const { return failure.empty() && output.rows.ok(); }
};

/// Experiments of many cases run one after the other, each on all threads; then the rest, each on one thread.
/// @param on_progress how many experiments are done; may be empty.
/// @return in the order of `entries`.
std::vector<FinishedExperiment> run_experiments(
    const std::vector<ExperimentEntry>& entries, const ExperimentInput& input,
    const std::function<void(std::size_t, std::size_t)>& on_progress);

}  // namespace sprung
