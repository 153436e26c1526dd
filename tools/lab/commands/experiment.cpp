#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>

#include "robots/overlay.h"
#include "runtime/log.h"
#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/play_pages.h"
#include "tools/lab/run/experiment_index.h"
#include "tools/lab/run/experiment_line.h"
#include "tools/lab/run/experiments.h"
#include "tools/logs/recorder/inprocess_log.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;

struct ExperimentOptions {
  ExperimentRequest request;
  std::string out;     ///< folder; empty: no files
  std::string report;  ///< HTML file; empty: none
  bool as_json = false;
};

/// Figures with it are not robot.yaml's.
RobotConfig loaded(const ExperimentRequest& request) {
  RobotConfig robot = robot_of(request);
  for (const OverlaidNumber& one : robot.overlay)
    std::fprintf(stderr, "note: %s\n", overlaid_text(one).c_str());
  return robot;
}

IndexHeading heading_of(const RobotConfig& robot, const ExperimentRequest& request) {
  return {robot.name, static_cast<std::uint64_t>(robot.hash ^ robot.overlay_hash), request.seed,
          "sprung experiment all --robot " + request.robot + plant_words(request) + " --seed " +
              std::to_string(request.seed)};
}

void write_files(const fs::path& folder, const IndexHeading& heading, const FinishedExperiment& finished) {
  if (finished.failure.empty())
    report::write_text(finished.rows.json() + "\n", folder / (finished.name + ".json"));
  for (const auto& [name, content] : finished.output.files) report::write_text(content, folder / name);
  report::write_report(experiment_page(heading, finished), folder / (finished.name + ".html"));
}

std::string text_of(const FinishedExperiment& finished) {
  const ExperimentOutput& output = finished.output;
  if (!output.instead.empty()) return output.instead;
  return output.before + (output.before.empty() ? "" : "\n") + finished.rows.table() +
         (output.remark.empty() ? "" : "\n" + output.remark);
}

int run_one(const Experiment& experiment, const ExperimentOptions& options, const std::string& logs) {
  start_log("sprung");
  if (!logs.empty() && !options.request.set.empty())
    throw WrongUse("--set with --logs: a log holds robot.yaml as it is, so that it could not be replayed");
  ExperimentRequest request = options.request;
  request.pages = !options.out.empty() || !options.report.empty();
  const RobotConfig robot = loaded(request);
  ExperimentInput input = experiment_input(experiment, request, robot);
  if (!options.out.empty()) input.play_page = play_pages_into(options.out);
  const FinishedExperiment finished = with_progress(experiment.name, [&](ProgressBar& bar) {
    input.parallel.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
    return run_experiment(experiment, input);
  });
  const IndexHeading heading = heading_of(robot, request);
  if (!options.out.empty()) write_files(options.out, heading, finished);
  if (!options.report.empty()) report::write_report(experiment_page(heading, finished), options.report);
  std::printf("%s\n", (options.as_json ? finished.rows.json() : text_of(finished)).c_str());
  return finished.ok() ? kExitDone : kExitFailed;
}

void add_common(CommandLine& line, const Experiment& experiment, ExperimentOptions& options) {
  const auto takes = [&](Common option) { return experiment.takes.count(option) > 0; };
  add_request_options(line, experiment, options.request);
  if (takes(Common::kOut))
    line.option(
        "--out", options.out,
        "folder for " + experiment.name + ".json and " + experiment.name + ".html" + experiment.out_note);
  if (takes(Common::kReport)) line.option("--report", options.report, "HTML file with tables and plots");
}

void add(CommandLine& parent, const Experiment& experiment, const std::shared_ptr<std::string>& logs) {
  const auto options = std::make_shared<ExperimentOptions>();
  CommandLine& line = parent.subcommand(experiment.name, experiment.what);
  add_common(line, experiment, *options);
  line.flag("--json", options->as_json, "one JSON object on standard output");
  line.example("sprung experiment " + experiment.name + " " + experiment.example);
  line.action([=] { return run_one(experiment, *options, *logs); });
}

int run_all(const ExperimentOptions& options) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = loaded(options.request);
  const std::vector<Experiment> all = experiments_of(robot);
  ProgressBar bar("experiments");
  bar.show(0, all.size());
  const std::vector<FinishedExperiment> finished = run_experiments(
      all, options.request, robot, [&bar](std::size_t done, std::size_t count) { bar.show(done, count); });
  IndexHeading heading = heading_of(robot, options.request);
  heading.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  const fs::path folder = options.out;
  bool ok = true;
  for (const FinishedExperiment& experiment : finished) {
    write_files(folder, heading, experiment);
    ok = ok && experiment.ok();
  }
  const std::string json = experiment_index_json(heading, finished);
  report::write_report(experiment_index(heading, finished), folder / "index.html");
  report::write_text(json + "\n", folder / "index.json");
  if (options.as_json) {
    std::printf("%s\n", json.c_str());
  } else {
    std::printf("%sin %.0f s: %s\n", experiment_index_text(finished).c_str(), heading.wall_s,
                (folder / "index.html").string().c_str());
  }
  return ok ? kExitDone : kExitFailed;
}

void add_all(CommandLine& experiment) {
  const auto options = std::make_shared<ExperimentOptions>();
  options->out = "report";
  options->request.in_all = options->request.pages = true;
  CommandLine& all = experiment.subcommand(
      "all", "Every experiment of a robot: one page with all tables and figures, a page and JSON for each.");
  all.option("--robot", options->request.robot, "name or folder");
  all.option("--seed", options->request.seed,
             "of every noise, and which plant bring_up draws; 0 was used for tuning");
  all.option("--plant", options->request.plant,
             "KEY=VALUE changes the plant, e.g. draw=7, of all that take it; may be repeated");
  all.option("--plants", options->request.plants,
             "N: on draws 1 to N of variation.yaml, or from --plant draw=K");
  all.option("--jobs", options->request.jobs, "threads; 0 = every core");
  all.option("--out", options->out, "folder for index.html, index.json and the experiments' own");
  all.flag("--json", options->as_json, "one JSON object on standard output");
  all.example("sprung experiment all --robot single_leg --seed 1 --out report");
  all.action([=] { return run_all(*options); });
}

/// Taken when the first robot is made: by then the command line is read.
std::shared_ptr<std::string> add_log_folder(CommandLine& experiment) {
  auto folder = std::make_shared<std::string>();
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
        if (auto for_page = observer_for_page(robot, preset, sim)) return for_page;
        return *logs ? (*logs)(robot, preset, sim) : nullptr;
      });
  return folder;
}

}  // namespace

void add_experiment(CommandLine& sprung) {
  CommandLine& experiment = sprung.subcommand("experiment",
                                              "Run an experiment on the simulated robot and print its rows.");
  experiment.example("sprung experiment jump --robot single_leg --preset paper --seed 1");
  const std::shared_ptr<std::string> logs = add_log_folder(experiment);
  for (const Experiment& one : experiments()) add(experiment, one, logs);
  add_all(experiment);
}

}  // namespace sprung::commands
