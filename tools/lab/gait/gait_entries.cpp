#include "tools/lab/gait/gait_entries.h"

#include "tools/lab/gait/walking_experiments.h"

namespace sprung {
namespace {

constexpr double kShort_min = 1.0;

ExperimentOutput run_one(const WalkingExperiment& experiment, const ExperimentInput& input) {
  WalkingInput in;
  in.robot = input.robot;
  in.preset = input.robot.preset().name;
  in.seed = input.seed;
  in.minutes = kShort_min;
  in.parallel.jobs = input.jobs;
  const WalkingOutput out = experiment.run(in);
  return {out.rows, out.sections};
}

}  // namespace

std::vector<ExperimentEntry> gait_entries(const std::string& preset) {
  std::vector<ExperimentEntry> out;
  for (const WalkingExperiment& experiment : gait_experiments())
    out.push_back({experiment.name, preset, experiment.question, true,
                   [&experiment](const ExperimentInput& input) { return run_one(experiment, input); }});
  return out;
}

}  // namespace sprung
