#include "tools/lab/commands/bench_recording.h"

#include <chrono>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/common/progress_bar.h"
#include "tools/lab/bench/recorder_bench.h"
#include "tools/lab/bench/replay_bench.h"
#include "tools/lab/commands/experiment_rows.h"

namespace sprung::commands {

namespace {

struct ReplayBench {
  std::string robot = "pegasus";
  int runs = 5;
  double duration_s = 20.0;
  std::string folder = "bench";
  bool as_json = false;
};

int finish(ExperimentReport& report, const std::chrono::steady_clock::time_point& start, bool as_json) {
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return print_rows(report, as_json);
}

int run_replay_bench(const ReplayBench& request) {
  if (request.runs < 1 || !(request.duration_s > 0.0))
    throw WrongUse("--runs is at least 1, --duration above 0 s");
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  ExperimentReport report;
  report.experiment = "replay";
  report.robot = request.robot;
  report.rows = bench_replay(load_robot(request.robot), request.runs, request.duration_s, request.folder);
  return finish(report, start, request.as_json);
}

void add_replay_bench(CommandLine& bench) {
  const auto request = std::make_shared<ReplayBench>();
  CommandLine& line = bench.subcommand(
      "replay",
      "A walking robot's log into estimator, planner and controller: times real time, bit for bit.");
  line.option("--robot", request->robot, "name or folder of one that walks");
  line.option("--runs", request->runs, "of which the median is printed");
  line.option("--duration", request->duration_s, "seconds that it walks");
  line.option("--out", request->folder, "folder for the log");
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung bench replay --robot pegasus");
  line.action([=] { return run_replay_bench(*request); });
}

int run_recorder_bench(RecorderBench request, bool as_json) {
  if (request.runs < 1 || request.messages < 1 || !(request.rate_Hz > 0.0) || request.hogs < 0)
    throw WrongUse("--runs, --messages and --rate are above 0, --hogs at least 0");
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar("recorder");
  request.on_run = [&](int run) {
    bar.show(static_cast<std::size_t>(run), static_cast<std::size_t>(request.runs));
  };
  ExperimentReport report;
  report.experiment = "recorder";
  report.rows = bench_recorder(request);
  return finish(report, start, as_json);
}

void add_recorder_bench(CommandLine& bench) {
  const auto request = std::make_shared<RecorderBench>();
  const auto as_json = std::make_shared<bool>(false);
  request->folder = "bench";
  CommandLine& line = bench.subcommand(
      "recorder", "What sprung-recorder and LCM's lcm-logger lose, beside each other, under load.");
  line.option("--runs", request->runs, "runs");
  line.option("--messages", request->messages, "in each run, on five channels");
  line.option("--rate", request->rate_Hz, "messages a second");
  line.option("--hogs", request->hogs, "processes that take the processor meanwhile");
  line.option("--out", request->folder, "folder for the logs, which are removed again");
  line.flag("--json", *as_json, "one JSON object on standard output");
  line.example("sprung bench recorder --runs 10 --hogs 4");
  line.action([=] { return run_recorder_bench(*request, *as_json); });
}

}  // namespace

void add_bench_recording(CommandLine& bench) {
  add_replay_bench(bench);
  add_recorder_bench(bench);
}

}  // namespace sprung::commands
