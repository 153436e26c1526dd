#include "tools/lab/commands/bench_up.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/lab/bench/up_bench.h"

namespace sprung::commands {

namespace {

struct UpBenchRequest {
  std::vector<std::string> robots;
  int runs = 5;
  bool as_json = false;
};

int run_bench_up(const UpBenchRequest& request) {
  if (request.runs < 1) throw WrongUse("--runs is at least 1");
  start_log("sprung");
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("sprung-bench-" + std::to_string(getpid()));
  const auto start = std::chrono::steady_clock::now();
  ExperimentReport report;
  report.experiment = "up";
  const std::vector<std::string> all{"single_leg", "pegasus"};
  for (const std::string& name : request.robots.empty() ? all : request.robots) {
    const auto rows = bench_up(load_robot(name), request.runs, folder.string());
    report.rows.insert(report.rows.end(), rows.begin(), rows.end());
    report.robot += (report.robot.empty() ? "" : ",") + name;
  }
  fs::remove_all(folder);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s\n", (request.as_json ? report.json() : report.table()).c_str());
  return report.ok() ? kExitDone : kExitFailed;
}

}  // namespace

void add_bench_up(CommandLine& bench) {
  const auto request = std::make_shared<UpBenchRequest>();
  CommandLine& up =
      bench.subcommand("up", "Seconds until every process of a robot with simulated drives is ready.");
  up.option("--robot", request->robots,
            "name or folder; may be repeated; single_leg and pegasus when none is given");
  up.option("--runs", request->runs, "of which the median is printed");
  up.flag("--json", request->as_json, "one JSON object on standard output");
  up.example("sprung bench up --robot pegasus");
  up.action([=] { return run_bench_up(*request); });
}

}  // namespace sprung::commands
