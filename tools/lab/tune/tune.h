#pragma once
/// `sprung experiment tune`: gains of a preset are varied over simulated jumps on several plants, evenly over
/// their ranges and then around the best. Tuned on one seed's plants, reported on another's.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/common/parallel.h"
#include "tools/lab/run/experiment.h"
#include "tools/lab/tune/tune_space.h"
#include "tools/lab/tune/tune_terms.h"

namespace sprung {

struct TuneRequest {
  JumpMode mode = JumpMode::kHybrid;
  TuneObjective objective = TuneObjective::kLandingOutput;
  int samples = 64;             ///< over the whole ranges
  int rounds = 2;               ///< of refinement, each with a quarter as many samples in a box half as wide
  int plants = 4;               ///< each set of gains jumps once on each
  std::uint64_t tune_seed = 0;  ///< of the plants to tune on
  std::uint64_t seed = 1;       ///< of the plants to report on; not tune_seed
  int jobs = 0;                 ///< ParallelOptions::jobs
};

struct TuneCandidate {
  std::vector<double> values;  ///< as TuneSpace::parameters()
  TuneTerms terms;
  double cost = 0.0;
};

struct TuneResult {
  /// On the tuning plants, the preset's own values first, in the order tried.
  std::vector<TuneCandidate> candidates;
  std::size_t best = 0;            ///< index of the least cost; the first of equals
  TuneCandidate present_reported;  ///< the preset's own values, on the plants of `seed`
  TuneCandidate best_reported;
  double simulated_s = 0.0;
};

/// Indices of candidates, cheapest first.
std::vector<std::size_t> by_cost(const std::vector<TuneCandidate>& candidates);

/// @param on_progress as ParallelOptions::on_progress, over all jumps of the search and the report.
/// @throws std::invalid_argument for the request, ConfigError where the robot may not hold a value.
TuneResult run_tune(const TuneSpace& space, const TuneRequest& request,
                    const std::function<void(std::size_t, std::size_t)>& on_progress = {});

Experiment tune_experiment();

}  // namespace sprung
