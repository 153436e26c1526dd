#include "tools/lab/commands/experiment_jump.h"

#include <sprung_version.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/jump/jump_ensemble.h"
#include "tools/lab/jump/jump_report.h"
#include "tools/lab/run/separate_run.h"
#include "tools/operate/commands/jump_mode.h"

namespace sprung::commands {
namespace {

struct JumpOptions {
  std::string robot = "single_leg";
  std::string preset;
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string out;
  bool separate = false;
  bool as_json = false;

  /// The line that makes it again.
  std::string command() const {
    std::string line = "sprung experiment jump --robot " + robot + " --preset " + preset;
    for (const std::string& change : plant) line += " --plant " + change;
    return line + " --seed " + std::to_string(seed) + (separate ? " --separate" : "");
  }
};

struct EnsembleOptions {
  std::string robot = "single_leg";
  JumpEnsembleRequest request;
  std::string mode = "hybrid";
  double height_mm = 0.0;
  int jobs = 0;
  std::string out;
  bool as_json = false;
};

void write_page(const JumpOptions& options, const RobotConfig& robot, const SimOptions& sim,
                const JumpExperiment& experiment) {
  report::Report page;
  page.title = "Jumps of " + robot.name;
  page.subtitle = "preset " + options.preset + ", seed " + std::to_string(options.seed) +
                  ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = options.command();
  page.sections = jump_sections(robot, sim, experiment);
  report::write_report(page, (std::filesystem::path(options.out) / "jump.html").string());
}

int run_jump(JumpOptions options) {
  start_log("sprung");
  SimOptions sim;
  sim.seed = options.seed;
  sim.plant = parse_plant(options.plant);
  const RobotConfig robot = load_robot(options.robot);
  options.preset = robot.preset(options.preset).name;
  JumpExperiment experiment = with_progress("jump", [&](ProgressBar&) {
    return run_jump_experiment(robot, options.preset, sim, script_runner(options.separate));
  });
  experiment.rows.separate_processes = options.separate;
  if (!options.out.empty()) {
    write_rows(experiment.rows, options.out);
    write_page(options, robot, sim, experiment);
  }
  return print_rows(experiment.rows, options.as_json);
}

int run_ensemble(EnsembleOptions options) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = load_robot(options.robot);
  options.request.preset = robot.preset(options.request.preset).name;
  options.request.mode = jump_mode(options.mode);
  options.request.height_m = 1e-3 * options.height_mm;
  ProgressBar bar("jump_ensemble");
  const JumpEnsemble ensemble = run_jump_ensemble(
      robot, options.request,
      {options.jobs, [&bar](std::size_t done, std::size_t count) { bar.show(done, count); }});
  ExperimentReport rows;
  rows.experiment = "jump_ensemble";
  rows.robot = robot.name;
  rows.preset = options.request.preset;
  rows.seed = options.request.seed;
  rows.simulated_s = ensemble.simulated_s;
  rows.rows = jump_ensemble_rows(ensemble);
  rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!options.out.empty()) write_rows(rows, options.out);
  return print_rows(rows, options.as_json);
}

void add_jump(CommandLine& experiment) {
  const auto options = std::make_shared<JumpOptions>();
  CommandLine& jump = experiment.subcommand(
      "jump",
      "One jump in position, torque and hybrid control beside the paper's numbers, and one with sprung's own "
      "landing.");
  jump.option("--robot", options->robot, "name or folder");
  jump.option(
      "--preset", options->preset,
      "set of parameters in robot.yaml; default: best, else the only one; paper reproduces the paper");
  jump.option("--seed", options->seed, "of every noise");
  jump.option("--plant", options->plant,
              "KEY=VALUE changes the plant, e.g. friction_scale=1.2; may be repeated");
  jump.flag("--separate", options->separate, "real processes over LCM instead of one process; the same bits");
  jump.option("--out", options->out, "folder for jump.json and the report jump.html");
  jump.flag("--json", options->as_json, "one JSON object on standard output");
  jump.example("sprung experiment jump --robot single_leg --preset paper --seed 3 --out logs/jump");
  jump.action([=] { return run_jump(*options); });
}

void add_jump_ensemble(CommandLine& experiment) {
  const auto options = std::make_shared<EnsembleOptions>();
  JumpEnsembleRequest& request = options->request;
  CommandLine& ensemble = experiment.subcommand(
      "jump_ensemble",
      "Jumps on plants with other friction, mass, torque constant and ground: falls, trips, heights before "
      "and after two jumps that adapt.");
  ensemble.option("--robot", options->robot, "name or folder");
  ensemble.option("--preset", request.preset,
                  "set of parameters in robot.yaml; default: best, else the only one");
  ensemble.choice("--mode", options->mode, jump_mode_names(), "control in the jump");
  ensemble.option("--height", options->height_mm, "mm that are asked; 0 = the preset's own jump");
  ensemble.option("--seed", request.seed, "of drawn plants and every noise; 0 was used for tuning");
  ensemble.option("--plants", request.plants, "how many are drawn");
  ensemble.option("--jobs", options->jobs, "simulations at once; 0 = one for each core");
  ensemble.option("--out", options->out, "folder for jump_ensemble.json");
  ensemble.flag("--json", options->as_json, "one JSON object on standard output");
  ensemble.example("sprung experiment jump_ensemble --seed 1");
  ensemble.action([=] { return run_ensemble(*options); });
}

}  // namespace

void add_jump_experiments(CommandLine& experiment) {
  add_jump(experiment);
  add_jump_ensemble(experiment);
}

}  // namespace sprung::commands
