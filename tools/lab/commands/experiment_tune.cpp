#include "tools/lab/commands/experiment_tune.h"

#include <sprung_version.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/tune/tune.h"
#include "tools/lab/tune/tune_report.h"
#include "tools/operate/commands/jump_mode.h"

namespace sprung::commands {
namespace {

struct TuneOptions {
  std::string robot = "single_leg";
  std::string preset;
  std::string mode = "hybrid";
  std::string objective = "landing_output";
  std::vector<std::string> vary;
  std::string out;
  bool as_json = false;
  TuneRequest request;

  /// The line that makes it again.
  std::string command() const {
    std::string text = "sprung experiment tune --robot " + robot + " --preset " + preset + " --mode " + mode;
    for (const std::string& range : vary) text += " --vary " + range;
    return text + " --samples " + std::to_string(request.samples) + " --rounds " +
           std::to_string(request.rounds) + " --plants " + std::to_string(request.plants) + " --objective " +
           objective + " --tune-seed " + std::to_string(request.tune_seed) + " --seed " +
           std::to_string(request.seed);
  }
};

void write_files(const TuneOptions& options, const TuneSpace& space, const TuneResult& result,
                 const ExperimentReport& rows) {
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  report::write_text(rows.json() + "\n", folder / "tune.json");
  report::write_text(tune_fragment(space, options.request, result, options.command()), folder / "tune.yaml");
  report::Report page{"Gains tuned on " + options.robot + ", preset " + options.preset};
  page.subtitle = "sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = options.command();
  page.sections = tune_sections(space, options.request, result);
  report::write_report(page, folder / "tune.html");
}

int run_tune(TuneOptions options) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  options.request.mode = jump_mode(options.mode);
  options.request.objective = tune_objective(options.objective);
  std::vector<TuneParameter> parameters;
  for (const std::string& text : options.vary) parameters.push_back(parse_vary(text));
  const RobotConfig robot = load_robot(options.robot);
  options.preset = robot.preset(options.preset).name;
  const TuneSpace space(robot, options.preset, parameters);
  ProgressBar bar("tune");
  const TuneResult result = run_tune(space, options.request,
                                     [&bar](std::size_t done, std::size_t count) { bar.show(done, count); });
  ExperimentReport rows;
  rows.experiment = "tune";
  rows.robot = options.robot;
  rows.preset = options.preset;
  rows.seed = options.request.seed;
  rows.rows = tune_rows(space, result);
  rows.simulated_s = result.simulated_s;
  rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!options.out.empty()) write_files(options, space, result, rows);
  const std::string text = options.as_json
                               ? rows.json()
                               : tune_table(space, options.request, result) +
                                     tune_fragment(space, options.request, result, options.command());
  std::printf("%s\n", text.c_str());
  return kExitDone;
}

}  // namespace

void add_tune_experiment(CommandLine& experiment) {
  const auto options = std::make_shared<TuneOptions>();
  TuneRequest& request = options->request;
  CommandLine& tune = experiment.subcommand(
      "tune",
      "Varies gains of a preset over jumps on several plants and shows the best and what they trade.");
  tune.option("--robot", options->robot, "name or folder");
  tune.option("--preset", options->preset,
              "set of parameters in robot.yaml to begin with; default: best, else the only one");
  tune.option("--vary", options->vary,
              "KEY=LOW:HIGH, a number of the preset and its range in robot.yaml's unit; may be repeated",
              Need::kRequired);
  tune.choice("--mode", options->mode, jump_mode_names(), "control in the jump");
  tune.choice("--objective", options->objective, tune_objectives(),
              "what counts; the output states the cost");
  tune.option("--samples", request.samples, "sets of gains over the whole ranges");
  tune.option("--rounds", request.rounds,
              "of refinement around the best, each with a quarter of the samples");
  tune.option("--plants", request.plants, "on which each set jumps: sim.yaml's, then drawn ones");
  tune.option("--tune-seed", request.tune_seed, "of the plants to tune on");
  tune.option("--seed", request.seed, "of the plants to report on");
  tune.option("--jobs", request.jobs, "threads; 0 = every core");
  tune.option("--out", options->out, "folder for tune.html, tune.json and tune.yaml");
  tune.flag("--json", options->as_json, "one JSON object on standard output");
  tune.example(
      "sprung experiment tune --vary hybrid_landing.stiffness.z=400:3000 --vary "
      "hybrid_landing.damping.z=5:120 --samples 64 --objective landing_output --out tuned");
  tune.action([=] { return run_tune(*options); });
}

}  // namespace sprung::commands
