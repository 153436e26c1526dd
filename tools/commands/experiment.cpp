#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "drivers/sim/sim_shell.h"
#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/commands/commands.h"
#include "tools/commands/experiment_estimator.h"
#include "tools/commands/experiment_joint.h"
#include "tools/experiments/fault_experiment.h"
#include "tools/experiments/jump_experiment.h"
#include "tools/experiments/separate_run.h"

namespace sprung::commands {

namespace {

struct ExperimentRequest {
  std::string robot = "single_leg";
  std::string preset = "best";
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string out;
  bool separate = false;
  bool as_json = false;
  bool as_markdown = false;
  std::string only;
};

void write_report(const ExperimentReport& report, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = std::filesystem::path(folder) / (report.experiment + ".json");
  std::ofstream out(path);
  out << report.json() << "\n";
  if (!out) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

int run_jump(const ExperimentRequest& request) {
  start_log("sprung");
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  const ScriptRunner runner = [&](const RunScript& script, const CycleObserver& on_cycle,
                                  const ReplyObserver& on_reply) {
    if (request.separate) {
      run_separate(script, on_cycle, on_reply);
    } else {
      run_in_process(script, on_cycle, on_reply);
    }
  };
  ExperimentReport report = run_jump_experiment(load_robot(request.robot), request.preset, sim, runner);
  report.separate_processes = request.separate;
  if (!request.out.empty()) {
    write_report(report, request.out);
  }
  std::printf("%s\n", (request.as_json ? report.json() : report.table()).c_str());
  return report.ok() ? kExitDone : kExitFailed;
}

bool wanted(const FaultCase& fault, const std::string& only) {
  return only.empty() || only == name(fault.kind);
}

int run_faults(const ExperimentRequest& request) {
  start_log("sprung");
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  const RobotConfig robot = load_robot(request.robot);
  std::vector<FaultOutcome> outcomes;
  for (const FaultCase& fault : fault_cases(robot)) {
    if (wanted(fault, request.only)) outcomes.push_back(run_fault(robot, request.preset, sim, fault));
  }
  if (outcomes.empty()) {
    throw std::invalid_argument("no fault '" + request.only + "'; see sprung fault --help");
  }
  const ExperimentReport report = fault_report(robot, request.preset, request.seed, outcomes);
  if (!request.out.empty()) {
    write_report(report, request.out);
  }
  const std::string text = request.as_json       ? report.json()
                           : request.as_markdown ? fault_table(outcomes)
                                                 : report.table();
  std::printf("%s\n", text.c_str());
  return report.ok() ? kExitDone : kExitFailed;
}

void add_faults(CommandLine& experiment, const std::shared_ptr<ExperimentRequest>& request) {
  CommandLine& faults = experiment.subcommand("faults",
                                              "Every fault on the simulated robot: when it is noticed, what "
                                              "follows, whether clear brings the robot back.");
  faults.option("--robot", request->robot, "name or folder");
  faults.option("--preset", request->preset, "set of parameters in robot.yaml");
  faults.option("--seed", request->seed, "of every noise");
  faults.option("--plant", request->plant, "KEY=VALUE changes the plant; may be repeated");
  faults.option("--only", request->only, "one kind of fault, e.g. bus-off");
  faults.option("--out", request->out, "folder for the report");
  faults.flag("--json", request->as_json, "one JSON object on standard output");
  faults.flag("--markdown", request->as_markdown, "the table of docs/drivers.md");
  faults.example("sprung experiment faults --robot single_leg --seed 1 --markdown");
  faults.action([=] { return run_faults(*request); });
}

}  // namespace

void add_experiment(CommandLine& sprung) {
  const auto request = std::make_shared<ExperimentRequest>();
  CommandLine& experiment =
      sprung.subcommand("experiment", "Run an experiment on the simulated robot and print its rows.");
  CommandLine& jump = experiment.subcommand(
      "jump", "One jump in position, torque and hybrid control, beside the paper's numbers.");
  jump.option("--robot", request->robot, "name or folder");
  jump.option("--preset", request->preset, "set of parameters in robot.yaml");
  jump.option("--seed", request->seed, "of every noise");
  jump.option("--plant", request->plant,
              "KEY=VALUE changes the plant, e.g. friction_scale=1.2; may be repeated");
  jump.flag("--separate", request->separate, "real processes over LCM instead of one process; the same bits");
  jump.option("--out", request->out, "folder for the report");
  jump.flag("--json", request->as_json, "one JSON object on standard output");
  jump.example("sprung experiment jump --robot single_leg --preset paper --seed 3 --json");
  jump.action([=] { return run_jump(*request); });
  add_faults(experiment, std::make_shared<ExperimentRequest>());
  add_joint_experiments(experiment);
  add_estimator_experiment(experiment);
}

}  // namespace sprung::commands
