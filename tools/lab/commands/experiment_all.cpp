#include "tools/lab/commands/experiment_all.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/run/experiment_index.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;

struct AllOptions {
  std::string robot = "single_leg";
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string out = "report";
  bool as_json = false;
};

void write_all(const fs::path& folder, const IndexHeading& heading,
               const std::vector<FinishedExperiment>& experiments) {
  fs::create_directories(folder);
  for (const FinishedExperiment& experiment : experiments) {
    report::write_report(experiment_page(heading, experiment),
                         (folder / (experiment.entry.name + ".html")).string());
    if (experiment.failure.empty())
      report::write_text(experiment.output.rows.json() + "\n", folder / (experiment.entry.name + ".json"));
  }
  report::write_report(experiment_index(heading, experiments), (folder / "index.html").string());
  report::write_text(experiment_index_json(heading, experiments) + "\n", folder / "index.json");
}

std::vector<ExperimentEntry> entries_or_refusal(const RobotConfig& robot) {
  try {
    return experiments_of(robot);
  } catch (const std::invalid_argument& reason) {
    throw WrongUse(reason.what());
  }
}

int run_all(const AllOptions& options) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  ExperimentInput input;
  input.robot = load_robot(options.robot);
  input.seed = options.seed;
  input.jobs = options.jobs;
  const std::vector<ExperimentEntry> entries = entries_or_refusal(input.robot);
  ProgressBar bar("experiments");
  bar.show(0, entries.size());
  const std::vector<FinishedExperiment> finished =
      run_experiments(entries, input, [&bar](std::size_t done, std::size_t count) { bar.show(done, count); });
  IndexHeading heading{
      input.robot.name, static_cast<std::uint64_t>(input.robot.hash), options.seed,
      "sprung experiment all --robot " + options.robot + " --seed " + std::to_string(options.seed)};
  heading.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  write_all(options.out, heading, finished);
  bool ok = true;
  for (const FinishedExperiment& experiment : finished) ok = ok && experiment.ok();
  if (options.as_json) {
    std::printf("%s\n", experiment_index_json(heading, finished).c_str());
  } else {
    std::printf("%sin %.0f s: %s\n", experiment_index_text(finished).c_str(), heading.wall_s,
                (fs::path(options.out) / "index.html").string().c_str());
  }
  return ok ? kExitDone : kExitFailed;
}

}  // namespace

void add_all_experiments(CommandLine& experiment) {
  const auto options = std::make_shared<AllOptions>();
  CommandLine& all = experiment.subcommand(
      "all", "Every experiment of a robot: one page with all tables and figures, a page and JSON for each.");
  all.option("--robot", options->robot, "name or folder");
  all.option("--seed", options->seed, "of every noise and of drawn plants; 0 was used for tuning");
  all.option("--jobs", options->jobs, "threads; 0 = every core");
  all.option("--out", options->out, "folder for index.html, index.json and the experiments' own");
  all.flag("--json", options->as_json, "one JSON object on standard output");
  all.example("sprung experiment all --robot single_leg --seed 1 --out report");
  all.action([=] { return run_all(*options); });
}

}  // namespace sprung::commands
