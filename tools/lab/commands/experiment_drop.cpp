#include "tools/lab/commands/experiment_drop.h"

#include <sprung_version.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/landing/drop_ablation.h"
#include "tools/lab/landing/drop_report.h"
#include "tools/lab/run/separate_run.h"

namespace sprung::commands {
namespace {

struct DropOptions {
  std::string robot = "single_leg";
  std::string preset;
  std::uint64_t seed = 1;
  int seeds = 50;
  int jobs = 0;
  std::vector<std::string> plant;
  std::string out;
  bool ablation = false;
  bool separate = false;
  bool as_json = false;

  /// The line that makes it again.
  std::string command() const {
    std::string line = "sprung experiment drop --robot " + robot + " --preset " + preset;
    for (const std::string& change : plant) line += " --plant " + change;
    return line + " --seed " + std::to_string(seed) + " --seeds " + std::to_string(seeds) +
           (separate ? " --separate" : "");
  }
};

void write_page(const DropOptions& options, const RobotConfig& robot, const DropRequest& request,
                const DropExperiment& experiment) {
  report::Report page;
  page.title = "Drops of " + robot.name;
  page.subtitle = "preset " + options.preset + ", seed " + std::to_string(options.seed) +
                  ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = options.command();
  page.sections = drop_sections(robot, request, experiment, script_runner(options.separate));
  report::write_report(page, (std::filesystem::path(options.out) / "drop.html").string());
}

int run_ablation(const DropOptions& options, const RobotConfig& robot, const DropRequest& request) {
  if (options.separate)
    throw std::invalid_argument(
        "--ablation changes parameters, which separate processes read from robot.yaml");
  const std::vector<AblationRow> ablation = run_drop_ablation(robot, request, run_in_process);
  if (!options.as_json) {
    std::printf("%s", ablation_table(ablation).c_str());
    return kExitDone;
  }
  ExperimentReport report;
  report.experiment = "drop";
  report.robot = robot.name;
  report.preset = options.preset;
  report.seed = options.seed;
  report.rows = ablation_rows(ablation);
  return print_rows(report, true);
}

int run_drops(DropOptions options) {
  start_log("sprung");
  const RobotConfig robot = load_robot(options.robot);
  options.preset = robot.preset(options.preset).name;
  DropRequest request;
  request.preset = options.preset;
  request.sim.seed = options.seed;
  request.sim.plant = parse_plant(options.plant);
  request.seeds = options.seeds;
  request.jobs = options.separate ? 1 : options.jobs;
  ProgressBar bar("drop");
  request.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
  if (options.ablation) return run_ablation(options, robot, request);
  DropExperiment experiment = run_drop_experiment(robot, request, script_runner(options.separate));
  experiment.rows.separate_processes = options.separate;
  if (!options.out.empty()) {
    write_rows(experiment.rows, options.out);
    write_page(options, robot, request, experiment);
  }
  return print_rows(experiment.rows, options.as_json);
}

}  // namespace

void add_drop_experiment(CommandLine& experiment) {
  const auto options = std::make_shared<DropOptions>();
  CommandLine& drop = experiment.subcommand(
      "drop",
      "Landings from 0.1 to 0.5 m in each mode; own landing against the papers' law, floor out of place.");
  drop.option("--robot", options->robot, "name or folder");
  drop.option("--preset", options->preset,
              "set of parameters in robot.yaml; default: best, else the only one");
  drop.option("--seed", options->seed, "of every noise; the comparison's first");
  drop.option("--seeds", options->seeds, "of the comparison");
  drop.option("--jobs", options->jobs, "threads; 0: one for each core");
  drop.option("--plant", options->plant, "KEY=VALUE changes the plant; may be repeated");
  drop.flag("--separate", options->separate,
            "real processes over LCM instead of one process, one run at a time; the same bits");
  drop.option("--out", options->out, "folder for the report");
  drop.flag("--ablation", options->ablation,
            "instead: own landing with one part taken out at a time, as a table");
  drop.flag("--json", options->as_json, "one JSON object on standard output");
  drop.example("sprung experiment drop --robot single_leg --seed 1 --out /tmp/drop");
  drop.action([=] { return run_drops(*options); });
}

}  // namespace sprung::commands
