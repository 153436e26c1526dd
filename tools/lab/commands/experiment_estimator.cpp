#include "tools/lab/commands/experiment_estimator.h"

#include <memory>

#include "runtime/log.h"
#include "tools/common/progress_bar.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/estimation/estimator_experiment.h"

namespace sprung::commands {
namespace {

struct EstimatorOptions {
  EstimatorRequest request;
  std::string out;
  bool as_json = false;
};

int run_estimator(const EstimatorOptions& options) {
  start_log("sprung");
  const ExperimentReport report = with_progress("estimator", [&](ProgressBar& bar) {
    return run_estimator_experiment(options.request,
                                    [&bar](std::size_t done, std::size_t count) { bar.show(done, count); });
  });
  if (!options.out.empty()) write_rows(report, options.out);
  return print_rows(report, options.as_json);
}

}  // namespace

void add_estimator_experiment(CommandLine& experiment) {
  const auto options = std::make_shared<EstimatorOptions>();
  CommandLine& estimator = experiment.subcommand(
      "estimator",
      "What the torque estimate is worth: against the simulation's truth and against recordings.");
  EstimatorRequest& request = options->request;
  estimator.option("--robot", request.robot,
                   "test_axis: the whole table, with the robots that it needs; "
                   "another robot: its own rows");
  estimator.option("--preset", request.preset,
                   "set of parameters in robot.yaml, of the jumps; default: best, else the only one");
  estimator.option("--seed", request.seed, "of every noise and of the drawn plants; 0 was used for tuning");
  estimator.option("--data", request.data, "folder of recordings; default ../shared/data where it is");
  estimator.option("--only", request.only, "one part of the table: " + estimator_sections());
  estimator.option("--out", options->out, "folder for the report");
  estimator.flag("--json", options->as_json, "one JSON object on standard output");
  estimator.example("sprung experiment estimator --robot test_axis --seed 1 --json");
  estimator.action([=] { return run_estimator(*options); });
}

}  // namespace sprung::commands
