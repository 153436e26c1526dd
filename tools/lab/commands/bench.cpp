#include <chrono>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/commands.h"
#include "tools/lab/bench/can_bench.h"
#include "tools/lab/commands/bench_inprocess.h"
#include "tools/lab/commands/bench_log.h"
#include "tools/lab/commands/bench_recording.h"
#include "tools/lab/commands/bench_up.h"
#include "tools/lab/commands/experiment_rows.h"

namespace sprung::commands {

namespace {

struct BenchRequest {
  std::vector<std::string> robots;
  int runs = 9;
  int cycles = 2000;
  bool as_json = false;
};

void append(std::vector<ReportRow>& rows, const std::vector<ReportRow>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

int run_can(const BenchRequest& request) {
  if (request.runs < 1 || request.cycles < 1) throw WrongUse("--runs and --cycles are at least 1");
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  ExperimentReport report;
  report.experiment = "can";
  append(report.rows, bench_codecs(request.runs));
  const std::vector<std::string> all{"single_leg", "pegasus"};
  for (const std::string& name : request.robots.empty() ? all : request.robots) {
    append(report.rows, bench_bridge(load_robot(name), request.runs, request.cycles));
    report.robot += (report.robot.empty() ? "" : ",") + name;
  }
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return print_rows(report, request.as_json);
}

}  // namespace

void add_bench(CommandLine& sprung) {
  const auto request = std::make_shared<BenchRequest>();
  CommandLine& bench = sprung.subcommand("bench", "Measure what the stack costs on this machine.");
  bench.example("sprung bench up; sprung bench can --robot pegasus");
  CommandLine& can = bench.subcommand(
      "can", "Encoding, decoding and the bridge's core, beside a reference loop of the same run.");
  can.option("--robot", request->robots,
             "name or folder; may be repeated; single_leg and pegasus when none is given");
  can.option("--runs", request->runs, "of which the median is printed");
  can.option("--cycles", request->cycles, "of the bridge in one run");
  can.flag("--json", request->as_json, "one JSON object on standard output");
  can.example("sprung bench can --robot pegasus --json");
  can.action([=] { return run_can(*request); });
  add_bench_up(bench);
  add_bench_inprocess(bench);
  add_bench_recording(bench);
  add_bench_log(bench);
}

}  // namespace sprung::commands
