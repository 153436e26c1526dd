#include <cstdio>
#include <memory>
#include <mutex>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/lab/commands/experiment_all.h"
#include "tools/lab/commands/experiment_drop.h"
#include "tools/lab/commands/experiment_estimator.h"
#include "tools/lab/commands/experiment_joint.h"
#include "tools/lab/commands/experiment_jump.h"
#include "tools/lab/commands/experiment_leg.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/commands/experiment_tune.h"
#include "tools/lab/commands/experiment_walking.h"
#include "tools/lab/faults/fault_experiment.h"
#include "tools/logs/recorder/inprocess_log.h"

namespace sprung::commands {

namespace {

struct ExperimentRequest {
  std::string robot = "single_leg";
  std::string preset;
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string out;
  bool as_json = false;
  bool as_markdown = false;
  std::string only;
};

bool wanted(const FaultCase& fault, const std::string& only) {
  return only.empty() || only == name(fault.kind);
}

int run_faults(ExperimentRequest request) {
  start_log("sprung");
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  const RobotConfig robot = load_robot(request.robot);
  request.preset = robot.preset(request.preset).name;
  std::vector<FaultCase> cases;
  for (const FaultCase& fault : fault_cases(robot)) {
    if (wanted(fault, request.only)) cases.push_back(fault);
  }
  std::vector<FaultOutcome> outcomes;
  with_progress("faults", [&](ProgressBar& bar) {
    for (const FaultCase& fault : cases) {
      bar.show(outcomes.size(), cases.size());
      outcomes.push_back(run_fault(robot, request.preset, sim, fault));
    }
  });
  if (outcomes.empty()) {
    throw std::invalid_argument("no fault '" + request.only + "'; see sprung fault --help");
  }
  const ExperimentReport report = fault_report(robot, request.preset, request.seed, outcomes);
  if (!request.out.empty()) write_rows(report, request.out);
  if (request.as_json || !request.as_markdown) return print_rows(report, request.as_json);
  std::printf("%s\n", fault_table(outcomes).c_str());
  return report.ok() ? kExitDone : kExitFailed;
}

void add_faults(CommandLine& experiment, const std::shared_ptr<ExperimentRequest>& request) {
  CommandLine& faults = experiment.subcommand("faults",
                                              "Every fault on the simulated robot: when it is noticed, what "
                                              "follows, whether clear brings the robot back.");
  faults.option("--robot", request->robot, "name or folder");
  faults.option("--preset", request->preset,
                "set of parameters in robot.yaml; default: best, else the only one");
  faults.option("--seed", request->seed, "of every noise");
  faults.option("--plant", request->plant, "KEY=VALUE changes the plant; may be repeated");
  faults.option("--only", request->only, "one kind of fault, e.g. bus-off");
  faults.option("--out", request->out, "folder for the report");
  faults.flag("--json", request->as_json, "one JSON object on standard output");
  faults.flag("--markdown", request->as_markdown, "the table of docs/drivers.md");
  faults.example("sprung experiment faults --robot single_leg --seed 1 --markdown");
  faults.action([=] { return run_faults(*request); });
}

/// Taken when the first robot is made: by then the command line is read.
void add_log_folder(CommandLine& experiment) {
  const auto folder = std::make_shared<std::string>();
  experiment.option(
      "--logs", *folder,
      "folder for an LCM log of each robot that runs in this process; stands before the experiment's "
      "name");
  const auto logs = std::make_shared<InProcessRobot::ObserverSource>();
  const auto begin = std::make_shared<std::once_flag>();
  InProcessRobot::observe_all_by(
      [=](const RobotConfig& robot, const std::string& preset, const SimOptions& sim) {
        std::call_once(*begin, [&] {
          if (!folder->empty()) *logs = logs_into(*folder, "sprung experiment --logs " + *folder);
        });
        return *logs ? (*logs)(robot, preset, sim) : nullptr;
      });
}

}  // namespace

void add_experiment(CommandLine& sprung) {
  CommandLine& experiment =
      sprung.subcommand("experiment", "Run an experiment on the simulated robot and print its rows.");
  experiment.example("sprung experiment jump --robot single_leg --preset paper --seed 1");
  add_log_folder(experiment);
  add_jump_experiments(experiment);
  add_faults(experiment, std::make_shared<ExperimentRequest>());
  add_drop_experiment(experiment);
  add_joint_experiments(experiment);
  add_leg_experiments(experiment);
  add_estimator_experiment(experiment);
  add_walking_experiments(experiment);
  add_tune_experiment(experiment);
  add_all_experiments(experiment);
}

}  // namespace sprung::commands
