#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/lab/bench/can_bench.h"
#include "tools/lab/bench/chain_bench.h"
#include "tools/lab/bench/hops_bench.h"
#include "tools/lab/bench/log_bench.h"
#include "tools/lab/bench/recorder_bench.h"
#include "tools/lab/bench/replay_bench.h"
#include "tools/lab/bench/stack_bench.h"
#include "tools/lab/bench/up_bench.h"
#include "tools/logs/commands/log/log_commands.h"

namespace sprung::commands {

namespace {

namespace fs = std::filesystem;
using Rows = std::vector<ReportRow>;

constexpr const char*
    kEachRobot = "name or folder; may be repeated; single_leg and pegasus when none is given";

/// Of all benches; each uses what it has options for.
struct BenchRequest {
  std::string robot = "pegasus";
  std::vector<std::string> robots;
  int runs = 0;
  double duration_s = 0.0;
  std::string folder = "bench";
  bool as_json = false;
};

/// Prints the rows that `measure` finds. @return the exit status.
int print_measured(const BenchRequest& request, const char* bench, const std::string& robot,
                   const std::function<Rows(ExperimentReport&)>& measure) {
  start_log("sprung");
  const auto start = std::chrono::steady_clock::now();
  ExperimentReport report;
  report.experiment = bench;
  report.robot = robot;
  report.rows = measure(report);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s\n", (request.as_json ? report.json() : report.table()).c_str());
  return report.ok() ? kExitDone : kExitFailed;
}

void append(Rows& rows, const Rows& more) { rows.insert(rows.end(), more.begin(), more.end()); }

/// @param rows so far. Robots' names stand in the report, with commas between.
Rows of_each_robot(const BenchRequest& request, ExperimentReport& report, Rows rows,
                   const std::function<Rows(const RobotConfig&)>& measure) {
  const std::vector<std::string> all{"single_leg", "pegasus"};
  for (const std::string& name : request.robots.empty() ? all : request.robots) {
    append(rows, measure(load_robot(name)));
    report.robot += (report.robot.empty() ? "" : ",") + name;
  }
  return rows;
}

CommandLine& add(CommandLine& bench, const std::string& name, const std::string& what,
                 const std::shared_ptr<BenchRequest>& request, const std::string& example) {
  CommandLine& line = bench.subcommand(name, what);
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung bench " + example);
  return line;
}

void add_can_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  const auto cycles = std::make_shared<int>(2000);
  request->runs = 9;
  CommandLine& line = add(
      bench, "can", "Encoding, decoding and the bridge's core, beside a reference loop of the same run.",
      request, "can --robot pegasus --json");
  line.option("--robot", request->robots, kEachRobot);
  line.option("--runs", request->runs, "of which the median is printed");
  line.option("--cycles", *cycles, "of the bridge in one run");
  line.action([=] {
    if (request->runs < 1 || *cycles < 1) throw WrongUse("--runs and --cycles are at least 1");
    return print_measured(*request, "can", "", [&](ExperimentReport& report) {
      return of_each_robot(*request, report, bench_codecs(request->runs), [&](const RobotConfig& robot) {
        return bench_bridge(robot, request->runs, *cycles);
      });
    });
  });
}

void add_up_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  request->runs = 5;
  CommandLine& line = add(bench, "up",
                          "Seconds until every process of a robot with simulated drives is ready.", request,
                          "up --robot pegasus");
  line.option("--robot", request->robots, kEachRobot);
  line.option("--runs", request->runs, "of which the median is printed");
  line.action([=] {
    if (request->runs < 1) throw WrongUse("--runs is at least 1");
    const fs::path folder = fs::temp_directory_path() / ("sprung-bench-" + std::to_string(getpid()));
    return print_measured(*request, "up", "", [&](ExperimentReport& report) {
      Rows rows = of_each_robot(*request, report, {}, [&](const RobotConfig& robot) {
        return bench_up(robot, request->runs, folder.string());
      });
      fs::remove_all(folder);
      return rows;
    });
  });
}

void add_inprocess_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  request->duration_s = 10.0;
  CommandLine& line = add(
      bench, "inprocess",
      "Simulation, bridge and cores in one process: times real time, and what each part costs.", request,
      "inprocess --robot pegasus");
  line.option("--robot", request->robot, "name or folder of one that walks");
  line.option("--duration", request->duration_s, "seconds that it walks");
  line.action([=] {
    if (!(request->duration_s > 0.0)) throw WrongUse("--duration must be above 0 s");
    return print_measured(*request, "inprocess", request->robot, [&](ExperimentReport& report) {
      report.simulated_s = request->duration_s;
      return bench_stack(load_robot(request->robot), request->duration_s);
    });
  });
}

void add_replay_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  request->runs = 5;
  request->duration_s = 20.0;
  CommandLine& line = add(
      bench, "replay",
      "A walking robot's log into estimator, planner and controller: times real time, bit for bit.", request,
      "replay --robot pegasus");
  line.option("--robot", request->robot, "name or folder of one that walks");
  line.option("--runs", request->runs, "of which the median is printed");
  line.option("--duration", request->duration_s, "seconds that it walks");
  line.option("--out", request->folder, "folder for the log");
  line.action([=] {
    if (request->runs < 1 || !(request->duration_s > 0.0))
      throw WrongUse("--runs is at least 1, --duration above 0 s");
    return print_measured(*request, "replay", request->robot, [&](ExperimentReport&) {
      return bench_replay(load_robot(request->robot), request->runs, request->duration_s, request->folder);
    });
  });
}

Rows recorder_rows(RecorderBench bench) {
  ProgressBar bar("recorder");
  bench.on_run = [&](int run) {
    bar.show(static_cast<std::size_t>(run), static_cast<std::size_t>(bench.runs));
  };
  return bench_recorder(bench);
}

void add_recorder_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  const auto recorder = std::make_shared<RecorderBench>();
  recorder->folder = "bench";
  CommandLine& line = add(bench, "recorder",
                          "What sprung-recorder and LCM's lcm-logger lose, beside each other, under load.",
                          request, "recorder --runs 10 --hogs 4");
  line.option("--runs", recorder->runs, "runs");
  line.option("--messages", recorder->messages, "in each run, on five channels");
  line.option("--rate", recorder->rate_Hz, "messages a second");
  line.option("--hogs", recorder->hogs, "processes that take the processor meanwhile");
  line.option("--out", recorder->folder, "folder for the logs, which are removed again");
  line.action([=] {
    if (recorder->runs < 1 || recorder->messages < 1 || !(recorder->rate_Hz > 0.0) || recorder->hogs < 0)
      throw WrongUse("--runs, --messages and --rate are above 0, --hogs at least 0");
    return print_measured(*request, "recorder", "",
                          [&](ExperimentReport&) { return recorder_rows(*recorder); });
  });
}

void add_hops_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  const auto hops = std::make_shared<HopsBench>();
  CommandLine& line = add(bench, "hops",
                          "A message through four programs: our receiver beside LCM's own, in turn.", request,
                          "hops --runs 5");
  line.option("--runs", hops->runs, "of each, of which the median is printed");
  line.option("--messages", hops->messages, "in a run");
  line.option("--rate", hops->rate_Hz, "messages a second");
  line.action([=] {
    if (hops->runs < 1 || hops->messages < 1 || !(hops->rate_Hz > 0.0))
      throw WrongUse("--runs, --messages and --rate are above 0");
    return print_measured(*request, "hops", "", [&](ExperimentReport&) { return bench_hops(*hops); });
  });
}

/// @param log to repeat; empty: one is recorded.
Rows log_rows(const BenchRequest& request, const std::string& log, int size_MB) {
  constexpr double kShortLog_s = 5.0;
  fs::create_directories(request.folder);
  const std::string source = log.empty()
                                 ? record_short_log(load_robot(request.robot), kShortLog_s, request.folder)
                                 : log;
  const std::string large = (fs::path(request.folder) / "large.lcm").string();
  or_wrong_use([&] { repeat_log(source, large, static_cast<std::uint64_t>(size_MB) * 1'000'000); });
  Rows rows = bench_log(large, request.runs);
  fs::remove(large);
  return rows;
}

void add_log_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  const auto log = std::make_shared<std::string>();
  const auto size_MB = std::make_shared<int>(1000);
  request->runs = 3;
  CommandLine& line = add(bench, "log",
                          "sprung log info, verify, csv and mcap on a long log, made of a short one, and the "
                          "memory that they take.",
                          request, "log --size 1000");
  line.option("--robot", request->robot, "legged robot whose log it is");
  line.option("--log", *log, "a log of your own to repeat instead");
  line.option("--size", *size_MB, "MB of the long log; it is removed afterwards");
  line.option("--runs", request->runs, "of which the median is printed");
  line.option("--folder", request->folder, "for the logs");
  line.action([=] {
    if (request->runs < 1 || *size_MB < 1) throw WrongUse("--runs and --size are at least 1");
    return print_measured(*request, "log", request->robot,
                          [&](ExperimentReport&) { return log_rows(*request, *log, *size_MB); });
  });
}

void add_chain_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  const auto logs = std::make_shared<std::vector<std::string>>();
  CommandLine& line = add(bench, "chain",
                          "From SYNC to the last set-point of each cycle, by CAN_TRACE of logs.", request,
                          "chain new-1.lcm new-2.lcm old-1.lcm old-2.lcm");
  line.option("log", *logs, "of robots in real time; the first half is compared with the second",
              Need::kRequired);
  line.action([=] {
    return print_measured(*request, "chain", "", [&](ExperimentReport&) { return bench_chain(*logs); });
  });
}

void add_mac_bench(CommandLine& bench) {
  const auto request = std::make_shared<BenchRequest>();
  request->runs = 9;
  CommandLine& line = add(bench, "mac", "Making the MAC of a message, by its size, beside a reference loop.",
                          request, "mac");
  line.option("--runs", request->runs, "of which the median is printed");
  line.action([=] {
    if (request->runs < 1) throw WrongUse("--runs is at least 1");
    return print_measured(*request, "mac", "", [&](ExperimentReport&) { return bench_mac(request->runs); });
  });
}

}  // namespace

void add_bench(CommandLine& sprung) {
  CommandLine& bench = sprung.subcommand("bench", "Measure what the stack costs on this machine.");
  bench.example("sprung bench up; sprung bench can --robot pegasus");
  add_can_bench(bench);
  add_chain_bench(bench);
  add_mac_bench(bench);
  add_up_bench(bench);
  add_inprocess_bench(bench);
  add_replay_bench(bench);
  add_recorder_bench(bench);
  add_hops_bench(bench);
  add_log_bench(bench);
}

}  // namespace sprung::commands
