#include "tools/lab/commands/bench_log.h"

#include <chrono>
#include <filesystem>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/lab/bench/log_bench.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/logs/commands/log/log_commands.h"

namespace sprung::commands {

namespace {

struct LogBench {
  std::string robot = "pegasus";
  std::string log;
  int size_MB = 1000;
  int runs = 3;
  std::string folder = "bench";
  bool as_json = false;
};

int run_bench(const LogBench& request) {
  if (request.runs < 1 || request.size_MB < 1) throw WrongUse("--runs and --size are at least 1");
  constexpr double kShortLog_s = 5.0;
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  std::filesystem::create_directories(request.folder);
  const std::string source = request.log.empty()
                                 ? record_short_log(load_robot(request.robot), kShortLog_s, request.folder)
                                 : request.log;
  const std::string large = (std::filesystem::path(request.folder) / "large.lcm").string();
  or_wrong_use([&] { repeat_log(source, large, static_cast<std::uint64_t>(request.size_MB) * 1'000'000); });
  ExperimentReport report;
  report.experiment = "log";
  report.robot = request.robot;
  report.rows = bench_log(large, request.runs);
  std::filesystem::remove(large);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return print_rows(report, request.as_json);
}

}  // namespace

void add_bench_log(CommandLine& bench) {
  const auto request = std::make_shared<LogBench>();
  CommandLine& line = bench.subcommand("log",
                                       "sprung log info, verify, csv and mcap on a long log, made of a short "
                                       "one, and the memory that they take.");
  line.option("--robot", request->robot, "legged robot whose log it is");
  line.option("--log", request->log, "a log of your own to repeat instead");
  line.option("--size", request->size_MB, "MB of the long log; it is removed afterwards");
  line.option("--runs", request->runs, "of which the median is printed");
  line.option("--folder", request->folder, "for the logs");
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung bench log --size 1000");
  line.action([=] { return run_bench(*request); });
}

}  // namespace sprung::commands
