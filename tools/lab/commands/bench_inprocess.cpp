#include "tools/lab/commands/bench_inprocess.h"

#include <chrono>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/commands.h"
#include "tools/lab/bench/stack_bench.h"
#include "tools/lab/commands/experiment_rows.h"

namespace sprung::commands {

namespace {

struct InprocessBench {
  std::string robot = "pegasus";
  double duration_s = 10.0;
  bool as_json = false;
};

int run(const InprocessBench& request) {
  if (!(request.duration_s > 0.0)) throw WrongUse("--duration must be above 0 s");
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  ExperimentReport report;
  report.experiment = "inprocess";
  report.robot = request.robot;
  report.simulated_s = request.duration_s;
  report.rows = bench_stack(load_robot(request.robot), request.duration_s);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return print_rows(report, request.as_json);
}

}  // namespace

void add_bench_inprocess(CommandLine& bench) {
  const auto request = std::make_shared<InprocessBench>();
  CommandLine& line = bench.subcommand(
      "inprocess", "Simulation, bridge and cores in one process: times real time, and what each part costs.");
  line.option("--robot", request->robot, "name or folder of one that walks");
  line.option("--duration", request->duration_s, "seconds that it walks");
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung bench inprocess --robot pegasus");
  line.action([=] { return run(*request); });
}

}  // namespace sprung::commands
